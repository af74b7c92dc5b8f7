// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Fields lognormal_fields(LognormalSettings& l)
{
    return {
        required({"median", &l.median, "m", "half of the mass (or number) is finer", positive()}),
        required({"sigma", &l.sigma, "", "standard deviation of ln(diameter)", positive()}),
        required({"minimum", &l.minimum, "m", "smallest diameter", positive()}),
        required({"maximum", &l.maximum, "m", "largest diameter", positive()}),
        {"classes", &l.classes, "", "of equal width in ln(diameter)", between(1, 1000)},
    };
}

Fields distribution_fields(DistributionSettings& d)
{
    Choice const basis{{"mass", "number"}, [&d] { return d.by_mass ? 0 : 1; }, [&d](int i) { d.by_mass = i == 0; }};
    return {
        {"basis", basis, "", "what the fractions are shares of"},
        {"diameters", &d.diameters, "m", "of the original grains (k = 1), ascending", positive()},
        {"fractions", &d.fractions, "", "share of each diameter; the sum is 1", between(0, 1)},
        {"lognormal", optional_table_of(d.lognormal, lognormal_fields), "",
         "instead of diameters and fractions; the resolved scene shows the classes that it makes"},
        {"count", &d.count, "", "how many grains, after coarse graining; or", not_negative()},
        {"solid_volume", &d.solid_volume, "m3", "volume of all grains; or", not_negative()},
        {"solid_fraction", &d.solid_fraction, "", "volume of all grains over that of the region", between(0, 0.74)},
        standing_for("the domain", {"region", optional_table_of(d.region, region_fields), "",
                                    "where they are put, in front of all walls that are there (meshes are not looked at)"}),
    };
}

} // namespace

Fields region_fields(Region& r)
{
    return {
        required({"lower", &r.lower, "m", "lower corner"}),
        required({"upper", &r.upper, "m", "upper corner"}),
    };
}

Fields particles_fields(ParticlesSettings& p)
{
    auto const any = [&p] { return p.source != ParticleSource::none; };
    auto const drawn = [&p] { return p.source == ParticleSource::distribution; };
    auto const read = [&p] { return p.source == ParticleSource::file || p.source == ParticleSource::checkpoint; };
    return {
        {"source", choice(p.source, {"none", "distribution", "file", "checkpoint"}), "",
         "a size distribution, a CSV of grains, or the checkpoint of another run (where its grains are, how they move and "
         "what they "
         "are of, by name; contacts and bonds begin anew)"},
        only_when(any, "a source",
                  {"material", &p.material, "",
                   "name of the grains' material; a CSV may have a column instead, a checkpoint has its own"}),
        required(only_when(drawn, "source = \"distribution\"",
                           {"distribution", table_of(p.distribution, distribution_fields), "", "sizes and amount"})),
        required(only_when(read, "source = \"file\" or \"checkpoint\"",
                           {"file", &p.file, "", "CSV of grains or checkpoint, relative to the scene file"})),
        only_when(any, "a source", {"held", &p.held, "", "every grain is frozen in place"}),
    };
}

Fields group_fields(GrainGroupSettings& g)
{
    return {
        required({"name", &g.name, "", "of your choice"}),
        {"ids", &g.ids, "", "grains by id, or", not_negative()},
        {"classes", &g.classes, "", "by size class, counted from 0, or", not_negative()},
        {"region", optional_table_of(g.region, region_fields), "", "by where they are at the start"},
        {"force", &g.force, "N", "constant force on each grain"},
        {"held", &g.held, "", "neither moves nor turns"},
        {"velocity", &g.velocity, "m/s", "moves so, whatever the forces"},
        {"spin", &g.spin, "rad/s", "turns so, with velocity"},
        standing_for("all stages", {"stages", WordList{&g.stages, {}}, "", "names of the stages in which this holds"}),
    };
}

} // namespace arenite::scene
