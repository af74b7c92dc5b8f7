// SPDX-License-Identifier: MIT
#include "kernels/stress.hpp"

namespace arenite {
namespace {

struct VirialTerms {
    ContactList list;
    RecordView position;
    PeriodicBox box;

    KOKKOS_FUNCTION Terms<3> operator()(int c) const
    {
        if (!list.touching(c)) return {{0, 0, 0}};
        Vec3 const branch = contact_offset(list, position, box, c);
        return {{list.force(c, 0) * branch.x, list.force(c, 1) * branch.y, list.force(c, 2) * branch.z}};
    }
};

} // namespace

Vec3 mean_stress(Particles const& particles, PeriodicBox const& box, ContactList const& contacts, SumWorkspace& workspace)
{
    if (contacts.count == 0) return {};
    Terms<3> const sums =
        reproducible_sums<3>(workspace, "mean_stress", contacts.count, VirialTerms{contacts, particles.position, box});
    Vec3 const size = box.size();
    Real const volume = size.x * size.y * size.z;
    return Vec3{sums[0], sums[1], sums[2]} / volume;
}

} // namespace arenite
