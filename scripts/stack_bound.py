# SPDX-License-Identifier: Apache-2.0
"""The most stack that the board's firmware can use, from its ELF; it must fit with a margin.

Frames and calls come from the disassembly, so that newlib's functions count like ours; the compiler's own figures
(`-fstack-usage`) must be the same wherever there are some. Recursion, a call through a pointer that
`firmware/stack.toml` does not list, and a frame whose size is not constant are errors.
"""

import re
import shutil
import subprocess
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.stack_frames import Function, Instruction, function, parse

ROOT = Path(__file__).resolve().parent.parent
ELF = ROOT / "build" / "firmware" / "touchdown.elf"
TABLE = ROOT / "firmware" / "stack.toml"
CROSS = "arm-none-eabi-"
POINTER_CALL = re.compile(r"^\s*([0-9a-f]+):\tbl?x\w*\t(?!lr)[a-z]\w+\s*$", re.MULTILINE)


def output_of(tool: str, *arguments: str) -> str:
    """What a tool of the cross compiler prints.

    Raises:
        UserError: it is absent or fails.
    """
    if shutil.which(CROSS + tool) is None:
        raise UserError(f"{CROSS}{tool} is not installed: run `make setup`.")
    run = subprocess.run([CROSS + tool, *arguments], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise UserError(f"{CROSS}{tool} failed: {run.stderr.strip()}.")
    return run.stdout


@dataclass
class Program:
    """An ELF as it is needed here.

    Attributes:
        disassembly: of `objdump -d --no-show-raw-insn`.
        symbols: address of each name.
        source_of: the function of the source, before inlining, that an instruction belongs to.
        usage: (name, bytes, kind) for each function in the compiler's .su files.
        taken: names of all whose address is taken.
        table: `firmware/stack.toml`.
    """

    disassembly: str
    symbols: dict[str, int]
    source_of: dict[int, str]
    usage: list[tuple[str, int, str]]
    taken: set[str]
    table: dict
    functions: dict[int, Function] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._labels = parse(self.disassembly)
        self._bounds: dict[int, tuple[int, list[tuple[str, int]]]] = {}

    def _after(self, address: int) -> int:
        """The next label behind an address; 0 behind the last."""
        return min((label for label in self._labels if label > address), default=0)

    def code_at(self, address: int) -> tuple[str, list[Instruction]]:
        """Name and instructions from an address on, which is `name+0x..` where the library jumps in before a label.

        Raises:
            UserError: there is no code.
        """
        label = max((label for label in self._labels if label <= address), default=0)
        name, body = self._labels.get(label, ("", []))
        rest = [instruction for instruction in body if instruction.address >= address]
        if rest and rest[0].address == address:
            return (name if label == address else f"{name}+{address - label:#x}"), rest
        raise UserError(f"a call goes to {address:x}, where there is no code.")

    def at(self, address: int) -> Function:
        """The function at an address.

        Raises:
            UserError: there is none, or its frame is not constant.
        """
        if address not in self.functions:
            name, body = self.code_at(address)
            most = self.table.get("register_bytes", {}).get(name, 0)
            within = name in self.table.get("jumps_within", [])
            self.functions[address] = function(name, body, self._after(address), most, within)
        return self.functions[address]

    def named(self, name: str) -> list[int]:
        """Addresses of the functions of that name: static ones may share it.

        Raises:
            UserError: there is none.
        """
        found = [address for address, (label, _) in self._labels.items() if label == name]
        if not found:
            raise UserError(f"firmware/stack.toml names {name}, which the ELF does not have.")
        return found

    def calls(self, caller: Function) -> list[tuple[int, int]]:
        """(address of the callee, bytes of the caller's frame), calls through pointers resolved.

        Raises:
            UserError: a pointer is not listed.
        """
        found = list(caller.calls)
        for address, depth in caller.indirect:
            source = self.source_of.get(address, caller.name)
            if source not in self.table["pointers"]:
                raise UserError(
                    f"{source} (in {caller.name}, {address:x}) calls through a pointer; "
                    "list what it may call under [pointers] of firmware/stack.toml."
                )
            found += [(place, depth) for name in self.table["pointers"][source] for place in self.named(name)]
        return found

    def bound(self, address: int, above: tuple[int, ...] = ()) -> tuple[int, list[tuple[str, int]]]:
        """Most bytes from a function down, and the path that takes them: (name, bytes) from caller to callee.

        Raises:
            UserError: it calls itself, directly or through others.
        """
        if address in above:
            names = [self.at(place).name for place in (*above[above.index(address) :], address)]
            raise UserError(f"recursion: {' > '.join(names)}; a loop with a bound is wanted.")
        if address not in self._bounds:
            this = self.at(address)
            best = (this.frame_bytes, [(this.name, this.frame_bytes)])
            for callee, depth in self.calls(this):
                below, path = self.bound(callee, (*above, address))
                if depth + below > best[0]:
                    best = (depth + below, [(this.name, depth), *path])
            self._bounds[address] = best
        return self._bounds[address]

    def deepest(self, names: list[str]) -> tuple[int, list[tuple[str, int]]]:
        """The bound of the worst of several functions; (0, []) for none."""
        bounds = [self.bound(address) for name in names for address in self.named(name)]
        return max(bounds, key=lambda bound: bound[0], default=(0, []))


def check_usage(program: Program) -> int:
    """Compare with the compiler's figures; number of functions that were compared.

    Raises:
        UserError: a frame differs or is not constant, or a function is in the ELF that nothing calls.
    """
    for name, size, kind in program.usage:
        if kind != "static":
            raise UserError(f"{name} takes {size} bytes and more ({kind}); an array of constant size is wanted.")
    labels = {re.sub(r"\.\d+$", "", name) for name, _ in program._labels.values()}
    reached = {re.sub(r"\.\d+$", "", this.name) for this in program.functions.values()}
    wanted: dict[str, list[int]] = {}
    for name, size, _ in program.usage:
        wanted.setdefault(name, []).append(size)
    compared = 0
    for name in sorted(labels & wanted.keys()):
        if name not in reached:
            raise UserError(f"nothing is seen to call {name}: list the pointer to it in firmware/stack.toml.")
        for this in program.functions.values():
            if re.sub(r"\.\d+$", "", this.name) == name:
                compared += 1
                if this.frame_bytes not in wanted[name]:
                    raise UserError(
                        f"{name} takes {this.frame_bytes} bytes by its code, {wanted[name]} by the compiler's word."
                    )
    return compared


def addresses_taken(listing: str) -> set[str]:
    """Names of the functions whose address some code or data holds, from `objdump -t -r` of the objects.

    A jump table holds places of its own section, which are left out, as debug information is.
    """
    shared: set[str] = set()
    held: list[tuple[str, set[str]]] = []
    own: set[str] = set()
    section = ""
    for line in listing.splitlines():
        if "file format" in line:
            own = set()
        elif (header := re.match(r"RELOCATION RECORDS FOR \[(.+)\]", line)) is not None:
            section = header[1]
        elif (symbol := re.match(r"[0-9a-f]{8} (.).{5}F \S+\s+[0-9a-f]+ (?:\.hidden )?(\S+)$", line)) is not None:
            (own if symbol[1] == "l" else shared).add(symbol[2])
        elif (entry := re.match(r"\w+ R_ARM_(?:ABS32|MOVW_ABS_NC|REL32|TARGET1)\s+([^+\s]+)", line)) is not None:
            aside = entry[1] == section or section.startswith((".debug", ".ARM.exidx"))
            held += [] if aside else [(re.sub(r"^\.text\.(?:startup\.)?", "", entry[1]), own)]
    return {name for name, local in held if name in local or name in shared}


def check_pointers(program: Program) -> None:
    """What is listed under [pointers] is called there, and is all whose address is taken.

    Raises:
        UserError: it is not.
    """
    pointers = program.table["pointers"]
    listed = {name for names in pointers.values() for name in names}
    taken = program.taken & {name for name, _, _ in program.usage}
    if absent := taken - listed:
        raise UserError(f"the address of {min(absent)} is taken; list who calls it in firmware/stack.toml.")
    if stale := listed - taken:
        raise UserError(f"firmware/stack.toml lists {min(stale)} under a pointer, but nothing takes its address.")
    functions = program.functions.values()
    met = {program.source_of.get(address, this.name) for this in functions for address, _ in this.indirect}
    if unmet := pointers.keys() - met:
        raise UserError(f"firmware/stack.toml lists a pointer call of {min(unmet)}, which makes none.")


def check_handlers(program: Program, names: list[str]) -> None:
    """No interrupt handler lets the next interrupt in.

    Raises:
        UserError: one does.
    """
    waiting = [place for name in names for place in program.named(name)]
    seen = set()
    while waiting:
        address = waiting.pop()
        if address in seen:
            continue
        seen.add(address)
        this = program.at(address)
        if this.unmasks:
            raise UserError(f"{this.name} lets interrupts in and is called from {names[0]}: they would nest.")
        waiting += [callee for callee, _ in program.calls(this)]


def check_vectors(program: Program) -> None:
    """Each exception that a table of vectors leads to has its stack in `firmware/stack.toml`.

    Raises:
        UserError: one has not.
    """
    stacks = program.table["stacks"].values()
    listed = {name for stack in stacks for name in (*stack["runs"], *stack.get("interrupted_by", []))}
    for address in (place for name in program.table["vectors"] for place in program.named(name)):
        for instruction in program.code_at(address)[1]:
            entry = re.search(r"<(.+)>", instruction.operands)
            if entry is not None and entry[1] not in listed:
                raise UserError(f"the vectors lead to {entry[1]}, which firmware/stack.toml gives no stack.")


def path_text(path: list[tuple[str, int]]) -> str:
    """A path as one line."""
    return " > ".join(f"{name} {size}" for name, size in path)


def check(program: Program) -> list[str]:
    """Lines that say the bound of each stack.

    Raises:
        UserError: a bound does not fit, or cannot be told.
    """
    lines = []
    check_vectors(program)
    margin = program.table["margin_percent"]
    for label, stack in program.table["stacks"].items():
        size = program.symbols[stack["top"]] - program.symbols[stack["bottom"]]
        handlers = stack.get("interrupted_by", [])
        check_handlers(program, handlers)
        own, path = program.deepest(stack["runs"])
        on_top, interrupt_path = program.deepest(handlers)
        total = own + on_top
        lines.append(f"{label}: {total} of {size} bytes ({100 * total / size:.1f} %)")
        lines.append(f"  {own}: {path_text(path)}")
        if handlers:
            lines.append(f"  {on_top}: {path_text(interrupt_path)}")
        if total > size * (100 - margin) / 100:
            raise UserError(
                f"the {label} stack has {size} bytes and may need {total}, which leaves less than {margin} %: "
                f"{path_text(path)}; make a frame smaller or the stack in firmware/board/touchdown.ld larger."
            )
    compared = check_usage(program)
    check_pointers(program)
    lines.append(f"{len(program.functions)} functions, {compared} of them as -fstack-usage says; no recursion")
    return lines


def load(elf: Path, objects: list[Path], table: Path) -> Program:
    """Read an ELF, its objects with the .su files beside them, and the table.

    Raises:
        UserError: one of them is absent or does not read.
    """
    if not elf.is_file():
        raise UserError(f"{elf} is absent: run `make firmware`.")
    usage_files = [path.with_suffix(".su") for path in objects if path.with_suffix(".su").is_file()]
    if not usage_files:
        raise UserError(f"there are no .su files beside {elf}: run `make clean firmware`.")
    disassembly = output_of("objdump", "-d", "--no-show-raw-insn", str(elf))
    symbols = {}
    for line in output_of("nm", str(elf)).splitlines():
        fields = line.split()
        if len(fields) == 3:
            symbols[fields[2]] = int(fields[0], 16)
    usage = []
    for path in usage_files:
        for line in path.read_text().splitlines():
            place, size, kind = line.split("\t")
            usage.append((place.split(":")[-1], int(size), kind))
    taken = addresses_taken(output_of("objdump", "-t", "-r", *map(str, objects)))
    program = Program(disassembly, symbols, {}, usage, taken, tomllib.loads(table.read_text()))
    pointers = POINTER_CALL.findall(disassembly)
    if pointers:
        # -f -p: one line each, the innermost inlined function.
        names = output_of("addr2line", "-f", "-p", "-e", str(elf), *pointers).splitlines()
        for address, line in zip(pointers, names, strict=True):
            name = line.split(" at ")[0]
            if name != "??":
                program.source_of[int(address, 16)] = name
    return program


def main() -> int:
    """Entry point."""
    parser = ArgumentParser(prog="python -m scripts.stack_bound", description=__doc__)
    parser.add_argument("--elf", type=Path, default=ELF, help="ELF with its objects beside it in arm/")
    options = parser.parse_args()
    folder = options.elf.parent / "arm"
    # A file left of a source that is gone says nothing.
    sources = {path: ROOT / "firmware" / path.relative_to(folder).with_suffix("") for path in folder.glob("**/*.o")}
    objects = sorted(path for path, source in sources.items() if source.is_file())
    print("\n".join(check(load(options.elf, objects, TABLE))))
    return 0


if __name__ == "__main__":
    run_main(main)
