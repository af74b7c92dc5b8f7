// SPDX-License-Identifier: MIT
#include "apps/verify/verify.hpp"

#include "apps/verify/checks.hpp"
#include "apps/verify/coarse_checks.hpp"
#include "apps/verify/coupling_checks.hpp"
#include "apps/verify/fluid_checks.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

std::string json_number(Real value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null"; }

std::string json_string(std::string const& text)
{
    std::string quoted = "\"";
    for (char const c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

std::string group_names()
{
    std::string names;
    for (VerifyGroup const& group : verify_groups()) names += (names.empty() ? "" : ", ") + group.name;
    return names;
}

} // namespace

std::vector<VerifyGroup> const& verify_groups()
{
    static std::vector<VerifyGroup> const groups{
        {"contact",
         {check_pair_constants, check_hertz_impacts, check_restitution, check_bouncing, check_exact_touch, check_jkr_points,
          check_jkr_curve, check_work_of_peeling, check_pull, check_sticking, check_bonded_release,
          check_bonded_oscillation}},
        {"friction",
         {check_friction_cycle, check_partial_slip, check_shear_paths, check_rigid_turns, check_incline,
          check_sliding_to_rolling, check_gear_spin, check_oblique_impacts, check_spinning_impacts}},
        {"integrator",
         {check_free_fall, check_pair_conservation, check_many_bodies, check_squeezed_pair, check_critical_step}},
        {"search", {check_pairs_found, check_periodic_crossing, check_independence}},
        {"fluid",
         {check_cavity, check_vortices, check_order_in_time, check_channel, check_brinkman, check_relaxation, check_darcy,
          check_fluid_at_rest, check_manufactured_flow, check_porosity_jumps, check_moving_porosity, check_holes,
          check_pressure_solver}},
        {"coupling",
         {check_single_grain, check_light_fluid, check_rising_gas, check_cell_sizes, check_momentum_balance, check_fixed_bed,
          check_ergun_bed, check_paper_bed, check_fluid_steps, check_fluidisation, check_bed_expansion,
          check_batch_settling}},
        {"coarse_graining",
         {check_coarse_grained_pair, check_coarse_speeds, check_lattice_stress, check_coarse_step, check_coarse_bed,
          check_coarse_settling}},
    };
    return groups;
}

namespace {

/// A check that stops is a row that fails, and the others go on.
std::vector<VerifyCase> rows_of(VerifyCheck check)
{
    try {
        return check();
    } catch (std::exception const& error) {
        return {expect_true({"a check stopped", error.what(), "exception"}, false)};
    }
}

} // namespace

std::vector<VerifyCase> run_verification(std::string const& group)
{
    std::vector<VerifyCase> cases;
    bool found = group.empty();
    for (VerifyGroup const& candidate : verify_groups()) {
        if (!group.empty() && candidate.name != group) continue;
        found = true;
        for (VerifyCheck const check : candidate.checks)
            for (VerifyCase row : rows_of(check)) {
                row.group = candidate.name;
                cases.push_back(std::move(row));
            }
    }
    if (!found) throw InputError(fmt::format("verify: there is no group '{}'; there are {}", group, group_names()));
    return cases;
}

std::string verification_table(std::vector<VerifyCase> const& cases)
{
    std::size_t name = 4, quantity = 8;
    for (VerifyCase const& row : cases) {
        name = std::max(name, row.name.size());
        quantity = std::max(quantity, row.quantity.size());
    }
    std::string table = fmt::format("{:<10} {:<{}} {:<{}} {:>15} {:>15} {:>9} {:>9}       source\n", "group", "case", name,
                                    "quantity", quantity, "value", "reference", "error", "limit");
    for (VerifyCase const& row : cases)
        table += fmt::format("{:<10} {:<{}} {:<{}} {:>15.9g} {:>15.9g} {:>9.1e} {:>9.1e} {:<5} {}\n", row.group, row.name,
                             name, row.quantity, quantity, row.value, row.reference, row.error, row.limit,
                             row.pass ? "ok" : "FAIL", row.source);
    auto const failed = std::count_if(cases.begin(), cases.end(), [](VerifyCase const& row) { return !row.pass; });
    return table + fmt::format("{} checks, {} failed\n", cases.size(), failed);
}

std::string verification_json(std::vector<VerifyCase> const& cases)
{
    std::string json = "[";
    for (VerifyCase const& row : cases) {
        json +=
            fmt::format("{}\n  {{\"group\": {}, \"name\": {}, \"quantity\": {}, \"value\": {}, \"reference\": {}, "
                        "\"error\": {}, \"limit\": {}, \"source\": {}, \"pass\": {}}}",
                        json.size() > 1 ? "," : "", json_string(row.group), json_string(row.name), json_string(row.quantity),
                        json_number(row.value), json_number(row.reference), json_number(row.error), json_number(row.limit),
                        json_string(row.source), row.pass ? "true" : "false");
    }
    return json + "\n]\n";
}

bool all_pass(std::vector<VerifyCase> const& cases)
{
    return std::all_of(cases.begin(), cases.end(), [](VerifyCase const& row) { return row.pass; });
}

} // namespace arenite
