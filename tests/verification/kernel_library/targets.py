"""From the module of intermediate code to a shared library for each platform, in the same way on every computer."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import llvmlite.binding as llvm

from qsbearing.model.compiler.library import file_of
from tests.verification.kernel_library.entry_points import PREFIX


class Target(NamedTuple):
    """For whom a library is made."""

    triple: str
    processor: str
    linked_for: str
    """As zig names it."""
    flags: tuple[str, ...] = ()


OLDEST_GLIBC = "gnu.2.17"
TARGETS = {
    "linux-x86_64": Target("x86_64-unknown-linux-gnu", "x86-64-v3", f"x86_64-linux-{OLDEST_GLIBC}", ("-nostdlib",)),
    "linux-aarch64": Target("aarch64-unknown-linux-gnu", "generic", f"aarch64-linux-{OLDEST_GLIBC}", ("-nostdlib",)),
    "macos-aarch64": Target("arm64-apple-macosx11.0.0", "apple-m1", "aarch64-macos.11.0"),
    "macos-x86_64": Target("x86_64-apple-macosx11.0.0", "x86-64-v3", "x86_64-macos.11.0"),
    "windows-x86_64": Target("x86_64-pc-windows-gnu", "x86-64-v3", "x86_64-windows-gnu"),
}

RUNS_HERE = f"{PREFIX}runs_here"
ALWAYS = f"define dllexport i32 @{RUNS_HERE}() {{\n  ret i32 1\n}}\n"
CPUID = 'call {i32, i32, i32, i32} asm sideeffect "cpuid", "={ax},={bx},={cx},={dx},{ax},{cx}"'
OF_LEAVES = {"1": (2, (12, 20, 22, 23, 27, 28, 29)), "7": (1, (3, 5, 8)), "-2147483647": (2, (5,))}
"""x86-64-v3: by leaf of `cpuid`, the register's number and its bits: FMA, SSE4.2, MOVBE, POPCNT, OSXSAVE, AVX, F16C;
BMI1, AVX2, BMI2; LZCNT."""
REGISTERS_KEPT = 6
"""Bits of the first extended control register: the system keeps the registers of SSE and AVX."""


def _runs_on_v3() -> str:
    """Whether the processor has what x86-64-v3 names, asked in the code that every x86-64 has."""
    lines = [f"%highest = {CPUID}(i32 0, i32 0)", "%most = extractvalue {i32, i32, i32, i32} %highest, 0"]
    lines += ["%knows_7 = icmp uge i32 %most, 7", "br i1 %knows_7, label %ask, label %no", "ask:"]
    for n, (leaf, (register, bits)) in enumerate(OF_LEAVES.items()):
        mask = sum(1 << bit for bit in bits)
        lines += [
            f"%leaf{n} = {CPUID}(i32 {leaf}, i32 0)",
            f"%bits{n} = extractvalue {{i32, i32, i32, i32}} %leaf{n}, {register}",
            f"%kept{n} = and i32 %bits{n}, {mask}",
            f"%has{n} = icmp eq i32 %kept{n}, {mask}",
            f"br i1 %has{n}, label %next{n}, label %no",
            f"next{n}:",
        ]
    lines += [
        '%control = call {i32, i32} asm sideeffect "xgetbv", "={ax},={dx},{cx}"(i32 0)',
        "%low = extractvalue {i32, i32} %control, 0",
        f"%both = and i32 %low, {REGISTERS_KEPT}",
        f"%saves = icmp eq i32 %both, {REGISTERS_KEPT}",
        "%found = zext i1 %saves to i32",
        "ret i32 %found",
        "no:",
        "ret i32 0",
    ]
    body = "\n  ".join(lines)
    return f'define dllexport i32 @{RUNS_HERE}() "target-cpu"="x86-64" {{\n  {body}\n}}\n'


def linked(name: str, text: str, folder: Path) -> Path:
    """The library of a platform, made in this folder from the module's text."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    llvm.initialize_native_asmparser()  # for `cpuid`, where this computer is to know it
    target = TARGETS[name]
    machine = llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=target.processor, features="", opt=3, reloc="pic", codemodel="default"
    )
    for what, value in (("datalayout", machine.target_data), ("triple", target.triple)):
        text = re.sub(f'^target {what} = ".*"$', f'target {what} = "{value}"', text, flags=re.MULTILINE)
    if not name.startswith("windows"):
        text = text.replace("define dllexport ", "define ")
    module = llvm.parse_assembly(text + (_runs_on_v3() if "x86_64" in name else ALWAYS))
    module.verify()
    library = folder / file_of(name)
    with tempfile.TemporaryDirectory() as work:
        made = Path(work) / "kernel.o"
        made.write_bytes(machine.emit_object(module))
        # The output's own name stands in some libraries.
        command = [*linker(target), "-shared", "-s", *target.flags, "-o", library.name, made.name]
        subprocess.run(command, check=True, cwd=work)
        content = (Path(work) / library.name).read_bytes()
    # At once, for processes may have the one before open.
    half = library.with_suffix(".new")
    half.write_bytes(without_time(content) if name.startswith("windows") else content)
    half.replace(library)
    return library


def without_time(content: bytes) -> bytes:
    """A library of Windows whose head does not say when it was linked."""
    at = int.from_bytes(content[0x3C:0x40], "little") + 8  # after "PE", the processor and the number of sections
    return content[:at] + bytes(4) + content[at + 4 :]


def linker(target: Target) -> list[str]:
    """zig's, which links for every platform; without it, the computer's own, for its own."""
    if find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc", "-target", target.linked_for]
    return ["cc"]
