// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Fields probe_fields(ProbeSettings& p)
{
    return {
        required({"name", &p.name, "", "of your choice"}),
        {"grain", &p.grain, "", "id of a grain, or", not_negative()},
        {"point", &p.point, "m", "a point of the fluid: the cell that holds it"},
    };
}

Fields line_fields(Region& line)
{
    return {
        required({"from", &line.lower, "m", "first seed"}),
        required({"to", &line.upper, "m", "last seed"}),
    };
}

Fields streamline_fields(StreamlineSettings& s)
{
    return {
        {"points", &s.points, "m", "seeds one by one"},
        {"line", optional_table_of(s.line, line_fields), "", "seeds along a line"},
        {"disc_center", &s.disc_center, "m", "seeds on a disc"},
        {"disc_normal", &s.disc_normal, "", "normal of the disc, of any length but 0"},
        {"disc_radius", &s.disc_radius, "m", "radius of the disc", not_negative()},
        {"count", &s.count, "", "seeds on the line and on the disc", between(0, 100000)},
        standing_for("four box diagonals", {"max_length", &s.max_length, "m", "a streamline ends there", not_negative()}),
    };
}

} // namespace

Fields output_fields(OutputSettings& o)
{
    OutputSettings const all;
    return {
        standing_for("100 rows a stage",
                     {"history_interval", &o.history_interval, "s", "between rows of history.csv", not_negative()}),
        standing_for("first and last state of every stage",
                     {"field_interval", &o.field_interval, "s", "between states of grains and fluid", not_negative()}),
        standing_for("the end of every stage",
                     {"checkpoint_interval", &o.checkpoint_interval, "s", "between checkpoints", not_negative()}),
        {"energies", &o.energies, "", "energy shares in history.csv"},
        {"grain_fields", WordList{&o.grain_fields, all.grain_fields}, "", "what the grain files hold"},
        {"fluid_fields", WordList{&o.fluid_fields, all.fluid_fields}, "", "what the fluid files hold"},
        {"probes", list_of(o.probes, probe_fields, "name"), "", "histories of single grains and cells"},
        {"streamlines", table_of(o.streamlines, streamline_fields), "", "where streamlines start"},
    };
}

} // namespace arenite::scene
