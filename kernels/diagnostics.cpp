// SPDX-License-Identifier: MIT
#include "kernels/diagnostics.hpp"

namespace arenite {
namespace {

struct GrainTerms {
    RecordView position, velocity, spin;

    KOKKOS_FUNCTION Terms<7> operator()(int i) const
    {
        Vec3 const v = vector_of(velocity, i), w = vector_of(spin, i);
        Real const mass = velocity(i, 3);
        return {{Real(0.5) * mass * dot(v, v), Real(0.5) * spin(i, 3) * dot(w, w), mass, sphere_volume(position(i, 3)),
                 mass * v.x, mass * v.y, mass * v.z}};
    }
};

} // namespace

GrainReport report_grains(Particles const& particles, SumWorkspace& workspace)
{
    GrainReport report;
    if (particles.count == 0) return report;
    GrainTerms const terms{particles.position, particles.velocity, particles.spin};
    Terms<7> const sums = reproducible_sums<7>(workspace, "report_grains", particles.count, terms);
    report.translation = sums[0];
    report.rotation = sums[1];
    report.mass = sums[2];
    report.volume = sums[3];
    report.momentum = {sums[4], sums[5], sums[6]};
    return report;
}

} // namespace arenite
