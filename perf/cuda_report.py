# SPDX-License-Identifier: MIT
"""Prints a CSV of what ptxas reported for the kernels of some object files: python3 perf/cuda_report.py OBJECT...

OBJECT.ptxas is the output of nvcc -Xptxas=-v for it (perf/cuda_report.sh makes it). One row per kernel:

  source        file
  kernel        function that launches it, or functor, with the names of its template arguments
  registers     per thread
  stack_bytes   per thread, local arrays and spills
  spill_bytes   stores and loads
  shared_bytes  static, per block
  occupancy     resident warps over 64, the best over block sizes: what Kokkos' choice of a block size can reach
"""
import pathlib
import re
import sys

# Hopper, from the CUDA programming guide's table of compute capability 9.0.
WARPS, BLOCKS, REGISTERS, SHARED = 64, 32, 65536, 233472
REGISTER_UNIT, SHARED_UNIT, SHARED_RESERVED = 256, 128, 1024  # allocated per warp; per block

NOISE = {"Kokkos", "Impl", "arenite", "RangePolicy", "IndexType", "Cuda", "OpenMP", "View", "CudaSpace", "ParallelFor",
         "ParallelReduce", "ParallelScan", "ParallelScanWithTotal", "CombinedFunctorReducer", "LaunchBounds", "Device",
         "CombinedReductionFunctorWrapper", "FunctorAnalysis", "Reducer", "reproducible", "WorkItemProperty",
         "ImplWorkItemProperty", "Experimental", "Turns",
         "cuda_parallel_launch_local_memory", "cuda_parallel_launch_constant_memory", "cuda_parallel_launch_global_memory"}

LOOPS = {"for_each_cell", "for_each_face", "for_each_node", "sum_chunks"}


def identifiers(mangled):
    """Names in a mangled symbol, in order; enough of the Itanium scheme for labels."""
    mangled = re.sub(r"L[a-z]\d+E", "", mangled)  # literals
    names, at = [], 0
    while at < len(mangled):
        if back_reference := re.compile(r"S[0-9A-Z]*_").match(mangled, at):
            at = back_reference.end()
        elif length := re.compile(r"\d+").match(mangled, at):
            at = length.end() + int(length.group())
            names.append(mangled[length.end():at])
        else:
            at += 1
    return names


def label(mangled):
    names = [name for name in identifiers(mangled) if name not in NOISE and "_cpp_" not in name and "INTERNAL" not in name]
    if not names:
        return "unnamed"
    if names[0] in LOOPS:  # and what runs in it
        inner = [name for name in names[1:] if name not in LOOPS and not name.startswith("_") and len(name) > 4]
        return names[0] + (f"<{inner[0]}>" if inner else "")
    if "Unvhdl" in mangled or names[0][0].islower():  # a lambda: its function says all
        return names[0]
    laws = [n for n in names[1:] if re.search(r"Law|Normal|Hertz|Jkr|Tangential|Mindlin|Spring|Secant|Box|Drag|Eval", n)]
    kind = re.search(r"BoxKindE(\d)E(Lb1E)?", mangled)
    laws += [["closed", "periodic", "deforming"][int(kind.group(1))]] if kind else []
    laws += ["several materials"] if kind and kind.group(2) else []
    unique = list(dict.fromkeys(n for n in laws if n not in ("ContactLaw", "BoxKind")))
    return names[0] + (f"<{' '.join(unique)}>" if unique else "")


def occupancy(registers, shared):
    best = 0
    per_warp = -(-registers * 32 // REGISTER_UNIT) * REGISTER_UNIT
    for warps in range(1, 33):
        blocks = min(BLOCKS, WARPS // warps, REGISTERS // (per_warp * warps))
        block_shared = -(-(shared + SHARED_RESERVED) // SHARED_UNIT) * SHARED_UNIT
        best = max(best, min(blocks, SHARED // block_shared) * warps)
    return best / WARPS


def rows(object_file):
    """(label, registers, stack, spills, shared) of each kernel in the report beside an object."""
    entry, stack, spills = None, 0, 0
    for line in pathlib.Path(str(object_file) + ".ptxas").read_text().splitlines():
        if match := re.search(r"Compiling entry function '(\S+)'", line):
            entry = match.group(1)
        elif match := re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", line):
            stack, spills = int(match.group(1)), int(match.group(2)) + int(match.group(3))
        elif (match := re.search(r"Used (\d+) registers", line)) and entry:
            shared = re.search(r"(\d+) bytes smem", line)
            yield label(entry), int(match.group(1)), stack, spills, int(shared.group(1)) if shared else 0
            entry = None


print("source,kernel,registers,stack_bytes,spill_bytes,shared_bytes,occupancy")
for path in sys.argv[1:]:
    source = re.sub(r"CMakeFiles/[^/]+/", "", path).removesuffix(".o")
    own = {row for row in rows(path) if not row[0].startswith(("View", "Cuda", "ZeroMemset"))}  # Kokkos' copies and fills
    for name, registers, stack, spills, shared in sorted(own):
        print(f"{source},{name},{registers},{stack},{spills},{shared},{occupancy(registers, shared):.3f}")
