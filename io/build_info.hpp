// SPDX-License-Identifier: MIT
// What this program was built from and what it runs on: one source for `arenite info`, summary.json and
// the messages about optional parts.
#pragma once

#include <string>
#include <vector>

namespace arenite {

struct OptionalPart {
    std::string name;
    bool present = false;
    std::string version; // empty where it is left out
    std::string without; // what the program does without it
};

/// MPI, HDF5 and VTK.
std::vector<OptionalPart> optional_parts();

/// One line for each part that is left out, for the start of a run.
std::vector<std::string> left_out_messages();

struct BuildInfo {
    std::string version; // of Arenite
    std::string commit;  // of git, "-modified" where the tree was not clean at configuration; "unknown" without git
    std::string compiler;
    std::string build_type;
    std::string kokkos, kokkos_kernels;
};
BuildInfo build_info();

struct Hardware {
    std::string cpu;     // model
    int cores = 0;       // logical ones that this process may use
    double memory = 0;   // bytes, of the machine
    std::string backend; // Kokkos execution space: OpenMP, Cuda, ...
    int concurrency = 0; // threads of that space that run at once
    std::string gpu;     // model; empty on the host
    std::string host;    // name
};
/// Kokkos must be running.
Hardware hardware();

/// Version, backend, hardware and parts as text, a line each.
std::string describe_build();

} // namespace arenite
