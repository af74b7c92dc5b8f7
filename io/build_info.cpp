// SPDX-License-Identifier: MIT
#include "io/build_info.hpp"

#include "build_config.hpp" // written by CMake

#include <Kokkos_Macros.hpp>
#include <fmt/format.h>

namespace arenite {

std::vector<OptionalPart> optional_parts()
{
    auto const part = [](char const* name, std::string const& version, char const* without) {
        return OptionalPart{name, !version.empty(), version, without};
    };
    return {part("MPI", build_config::mpi, "runs on one rank"),
            part("HDF5", build_config::hdf5, "no checkpoints: a run can be neither resumed nor started from one"),
            part("VTK", build_config::vtk, "fields are written uncompressed and no streamlines are traced")};
}

std::vector<std::string> left_out_messages()
{
    std::vector<std::string> messages;
    for (OptionalPart const& part : optional_parts())
        if (!part.present)
            messages.push_back(fmt::format("built without {0}: {1} (ARENITE_ENABLE_{0})", part.name, part.without));
    return messages;
}

BuildInfo build_info()
{
    BuildInfo info;
    info.version = build_config::version;
    info.commit = build_config::commit;
    info.compiler = build_config::compiler;
    info.build_type = build_config::build_type;
    info.kokkos = fmt::format("{}.{}.{}", KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100, KOKKOS_VERSION % 100);
    info.kokkos_kernels = build_config::kokkos_kernels;
    return info;
}

std::string describe_build()
{
    BuildInfo const build = build_info();
    Hardware const machine = hardware();
    std::string text =
        fmt::format("Arenite {} ({}), {}, {}\n", build.version, build.commit, build.compiler, build.build_type);
    text += fmt::format("Kokkos {}, Kokkos Kernels {}, backend {} with {} threads at once\n", build.kokkos,
                        build.kokkos_kernels, machine.backend, machine.concurrency);
    text += fmt::format("CPU: {}, {} logical cores, {:.1f} GiB\n", machine.cpu, machine.cores, machine.memory / (1 << 30));
    text += fmt::format("GPU: {}\n", machine.gpu.empty() ? "not used" : machine.gpu);
    for (OptionalPart const& part : optional_parts())
        text += fmt::format("{}: {}\n", part.name, part.present ? part.version : "left out (" + part.without + ")");
    return text;
}

} // namespace arenite
