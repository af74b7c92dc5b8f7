// SPDX-License-Identifier: MIT
#include "io/summary.hpp"

#include "io/atomic_file.hpp"
#include "io/build_info.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace arenite {
namespace {

using Json = nlohmann::ordered_json;

template <class T> Json json_of(std::optional<T> const& value) { return value ? Json(*value) : Json(); }

Json json_of(Vec3 const& v) { return Json::array({v.x, v.y, v.z}); }

Json versions()
{
    BuildInfo const build = build_info();
    Json json{{"arenite", build.version},  {"commit", build.commit}, {"compiler", build.compiler},
              {"build", build.build_type}, {"kokkos", build.kokkos}, {"kokkos_kernels", build.kokkos_kernels}};
    for (OptionalPart const& part : optional_parts()) json[part.name] = part.present ? Json(part.version) : Json();
    return json;
}

Json machine(int ranks)
{
    Hardware const m = hardware();
    return {{"host", m.host},
            {"cpu", m.cpu},
            {"logical_cores", m.cores},
            {"memory_bytes", m.memory},
            {"backend", m.backend},
            {"concurrency", m.concurrency},
            {"gpu", m.gpu.empty() ? Json() : Json(m.gpu)},
            {"ranks", ranks}};
}

Json walls_of(StageSummary const& stage)
{
    Json json = Json::object();
    for (WallSummary const& wall : stage.walls)
        json[wall.name] = {{"force", json_of(wall.force)}, {"stress", json_of(wall.stress)}};
    return json;
}

Json json_of(StageSummary const& stage)
{
    Json json{{"name", stage.name},
              {"ended_by", stage.ended_by},
              {"wall_time", stage.wall_time},
              {"simulated_time", stage.simulated_time},
              {"steps", stage.steps},
              {"particle_steps_per_second", stage.wall_time > 0 ? Json(stage.particle_steps / stage.wall_time) : Json()}};
    json["end_state"] = {{"grains", stage.grains},
                         {"contacts", stage.contacts},
                         {"bonds", stage.bonds},
                         {"porosity", json_of(stage.porosity)},
                         {"coordination", json_of(stage.coordination)},
                         {"kinetic_energy", stage.kinetic_energy},
                         {"walls", walls_of(stage)}};
    json["max_overlap_ratio"] = stage.max_overlap_ratio;
    json["produced"] = {{"mass", stage.produced_mass}, {"count", stage.produced_count}};
    json["lost"] = {{"mass", stage.lost_mass}, {"count", stage.lost_count}};
    json["warnings"] = stage.warnings;
    json["values"] = stage.values;
    return json;
}

} // namespace

std::string finished_stages(std::filesystem::path const& folder, std::vector<std::string> const& names)
{
    Json kept = Json::array();
    try {
        Json const old = Json::parse(read_file(folder / "summary.json"));
        for (std::string const& name : names)
            for (Json const& stage : old.at("stages"))
                if (stage.at("name") == name && stage.at("ended_by") != "stopped" && stage.at("ended_by") != "" &&
                    stage.contains("lost")) // else an earlier version wrote it, whose checkpoints nobody reads
                    kept.push_back(stage);
    } catch (InputError const&) { // no summary yet
        return {};
    } catch (Json::exception const&) { // not one of ours
        return {};
    }
    return kept.empty() ? std::string() : kept.dump();
}

std::string summary_json(RunSummary const& summary)
{
    Json json{{"scene",
               {{"path", summary.scene},
                {"title", summary.title},
                {"hash", fmt::format("{:016x}", summary.scene_hash)},
                {"random_seed", summary.random_seed}}},
              {"outcome", summary.outcome},
              {"resumed_from_step", json_of(summary.resumed_from_step)},
              {"wall_time", summary.wall_time},
              {"versions", versions()},
              {"machine", machine(summary.ranks)}};
    Real mass = 0, lost_mass = 0;
    std::int64_t count = 0, lost_count = 0;
    std::map<std::string, std::int64_t> warnings;
    json["stages"] = summary.earlier_stages.empty() ? Json::array() : Json::parse(summary.earlier_stages);
    for (Json const& stage : json["stages"]) {
        mass += stage["produced"]["mass"].get<Real>();
        count += stage["produced"]["count"].get<std::int64_t>();
        lost_mass += stage["lost"]["mass"].get<Real>();
        lost_count += stage["lost"]["count"].get<std::int64_t>();
        for (auto const& [kind, number] : stage["warnings"].items()) warnings[kind] += number.get<std::int64_t>();
    }
    for (StageSummary const& stage : summary.stages) {
        json["stages"].push_back(json_of(stage));
        mass += stage.produced_mass;
        count += stage.produced_count;
        lost_mass += stage.lost_mass;
        lost_count += stage.lost_count;
        for (auto const& [kind, number] : stage.warnings) warnings[kind] += number;
    }
    json["produced"] = {{"mass", mass}, {"count", count}};
    json["lost"] = {{"mass", lost_mass}, {"count", lost_count}};
    json["warnings"] = warnings;
    // Names come from the user's file: bytes that are no UTF-8 are replaced, not refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(std::filesystem::path const& folder, RunSummary const& summary)
{
    write_file_atomically(folder / "summary.json", summary_json(summary));
}

} // namespace arenite
