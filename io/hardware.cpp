// SPDX-License-Identifier: MIT
#include "core/types.hpp"
#include "io/build_info.hpp"

#include <fstream>
#include <sched.h>
#include <unistd.h>

namespace arenite {
namespace {

std::string cpu_model()
{
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos) return line.substr(line.find(": ") + 2);
    return "unknown";
}

int usable_cores()
{
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
    return static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
}

/// The device's own name, from whichever of Kokkos' GPU spaces the default one is.
template <class Space> std::string gpu_model(Space const& space)
{
    if constexpr (requires { space.cuda_device_prop().name; }) return space.cuda_device_prop().name;
    else if constexpr (requires { space.hip_device_prop().name; }) return space.hip_device_prop().name;
    else return {};
}

} // namespace

Hardware hardware()
{
    ExecutionSpace const space;
    Hardware machine;
    machine.cpu = cpu_model();
    machine.cores = usable_cores();
    machine.memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    machine.backend = ExecutionSpace::name();
    machine.concurrency = space.concurrency();
    machine.gpu = gpu_model(space);
    char name[256] = {};
    if (::gethostname(name, sizeof name - 1) == 0) machine.host = name;
    return machine;
}

} // namespace arenite
