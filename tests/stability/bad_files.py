# SPDX-License-Identifier: MIT
"""bad_files.py CASE PROGRAM SCENES: what the program says of files that it cannot read or write
  checkpoints  corrupt, truncated, foreign, of another scene: exit code 2, one message, the folder untouched,
  disk         full (a small file system; where none can be mounted a limit on the size of files): exit code 1, one message that
               names the file and the cause; the last checkpoint is readable and the run goes on from it when there is room,
  read_only    a folder that cannot be written: exit code 1, one message, the folder untouched."""

import hashlib
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "runs"))
from program import Arenite, checkpoints, expect, expect_same_run, finish, with_checkpoints

UNTIL = "2e-3"  # s of the small scene: the middle of the perforation


def digest(folder: Path) -> dict[str, tuple[str, int]]:
    return {str(p.relative_to(folder)): (hashlib.md5(p.read_bytes()).hexdigest(), p.stat().st_mtime_ns)
            for p in sorted(folder.rglob("*")) if p.is_file()}


def expect_one_message(said: str, *parts: str) -> None:
    lines = [line for line in said.splitlines() if line and "last checkpoint" not in line and "no checkpoint was due" not in line]
    expect(len(lines) == 1 and all(part in lines[0] for part in parts), f"is not one message with {parts}: {said[-500:]}")


def damaged(whole: bytes, foreign: bytes) -> dict[str, tuple[bytes, str]]:
    """Content and what the message has to say."""
    choice, size = random.Random(5), len(whole)
    cases = {f"truncated to {n}": (whole[:n], "truncated") for n in (size - 1, size - 4096, size // 2, size // 3, 4096, 600)}
    cases |= {"truncated to 100": (whole[:100], "its header is"), "empty": (b"", "the file is empty"),
              "longer": (whole + b"\0", "damaged"), "text": (b"time,mass\n", "not an HDF5 file"), "foreign": (foreign, "another program"),
              "of a later version": (re.sub(rb"checkpoint format \d+", b"checkpoint format 999", whole, count=1), "format 999")}
    for n in range(6):
        at = choice.randrange(512, size)
        cases[f"byte {at} changed"] = (whole[:at] + bytes([whole[at] ^ 0x41]) + whole[at + 1 :], "its checksum is wrong")
    at = whole.index(b"step ")
    cases["header changed"] = (whole[:at] + b"stop " + whole[at + 5 :], "its header is")
    return cases


def check_checkpoints(program: Arenite, scene: Path, scratch: Path) -> None:
    folder = scratch / "run"
    program.run(scene, folder, "--until", "stir")
    last = checkpoints(folder)[-1]
    whole = last.read_bytes()
    foreign = whole[512:]  # HDF5 begins there
    expect(foreign[:4] == b"\x89HDF", "the HDF5 part of a checkpoint")
    bad = scratch / "bad.h5"
    before = digest(folder)
    for what, (content, message) in damaged(whole, foreign).items():
        bad.write_bytes(content)
        said = program.run(scene, folder, "--resume", str(bad), code=2)
        expect_one_message(said, "bad.h5", message)
        expect(digest(folder) == before, f"{what}: the folder of the run was touched")
    said = program.run(scene, folder, "--resume", str(scratch / "none.h5"), code=2)
    expect("none.h5" in said and "No such file" in said, f"says {said}")
    said = program.run(scene, folder, "--set", "materials.sand.friction=0.31", "--resume", str(last), code=2)
    expect("another scene" in said, f"says {said}")
    said = program.run(scene, folder, "--set", "output.energies=true", "--resume", code=2)
    expect("its columns are not those of this scene" in said, f"says {said}")
    expect(digest(folder) == before, "a resume that is refused touched the folder")

    # Of a folder the newest whole one is taken; where none is left, none.
    last.write_bytes(whole[: len(whole) // 2])
    said = program.run(scene, folder, "--resume")
    expect("passed over: " + str(last) in said, f"says {said}")
    for path in checkpoints(folder):
        path.write_bytes(b"")
    before = digest(folder)
    program.run(scene, folder, "--resume", code=2)
    expect(digest(folder) == before, "a folder without a whole checkpoint was touched")


def mounted(folder: Path, megabytes: int) -> bool:
    folder.mkdir()
    return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "none", str(folder)], capture_output=True).returncode == 0


def check_disk(program: Arenite, scene: Path, scratch: Path) -> None:
    """On a real full disk, and under limits on the size of a file, which hit each kind of file in turn."""
    scene = with_checkpoints(scene, scratch, 2e-4)
    reference = scratch / "whole"
    program.run(scene, reference)
    largest = max(path.stat().st_size for path in checkpoints(reference))
    folder = scratch / "limited"
    for limit in (largest - 1, 400, largest // 3):
        shutil.rmtree(folder, ignore_errors=True)
        said = program.run(scene, folder, code=1, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        expect("File too large" in said and str(folder) in said, f"a limit of {limit} bytes: says {said[-400:]}")
        expect(not list(folder.rglob("*.unfinished")), "a half-written file is left")
        program.run(scene, folder, *(["--resume"] if checkpoints(folder) else []))
        expect_same_run(folder, reference, f"after a limit of {limit} bytes")
    disk = scratch / "disk"
    if not mounted(disk, 1):
        print("not done: no file system can be mounted here, so none was filled", flush=True)
        return
    try:
        folder = disk / "run"
        said = program.run(scene, folder, code=1)
        expect("No space left on device" in said and str(folder) in said, f"a full disk: says {said[-400:]}")
        expect("are free, and three checkpoints take" in program.run(scene, folder, "--resume", code=1), "no warning before the run")
        expect(len(checkpoints(folder)) > 0, "no checkpoint on the full disk")
        elsewhere = scratch / "elsewhere"
        shutil.copytree(folder, elsewhere)
        said = program.run(scene, elsewhere, "--resume")
        expect("passed over" not in said, f"a full disk left a damaged checkpoint: {said}")
        expect_same_run(elsewhere, reference, "after a full disk")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def check_read_only(program: Arenite, scene: Path, scratch: Path) -> None:
    nobody = 65534
    options: dict = {"user": nobody, "group": nobody} if os.geteuid() == 0 else {}  # root may write anywhere
    folder = scratch / "run"
    program.run(scene, folder, "--until", "stir")
    for path in [scratch, folder, *folder.rglob("*")]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    before = digest(folder)
    for words in ([], ["--resume"]):
        said = program.run(scene, folder, *words, code=1, **options)
        expect_one_message(said, str(folder), "Permission denied")
        expect(digest(folder) == before, "a folder that cannot be written was written")
    said = program.run(scene, scratch / "new", code=1, **options)
    expect_one_message(said, str(scratch / "new"), "cannot create the folder", "Permission denied")
    scratch.chmod(0o755)
    folder.chmod(0o755)


def main() -> None:
    case, program, scenes = sys.argv[1], Arenite(sys.argv[2]), Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        if case == "checkpoints":
            check_checkpoints(program, scenes / "periodic.toml", scratch)
        elif case == "disk":
            check_disk(program, scenes / "periodic.toml", scratch)
        elif case == "read_only":
            check_read_only(program, scenes / "periodic.toml", scratch)
    finish()


main()
