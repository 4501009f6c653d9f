# SPDX-License-Identifier: Apache-2.0
"""`make flash` and `make sdcard` against stand-ins of their tools, on a PATH that has nothing else."""

import re
import shlex
import struct
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from scripts import flash, sdcard
from scripts.errors import UserError
from scripts.flash_steps import SCRIPTS
from scripts.lint_run import need
from tb.common.cores import ROOT

TOOLS = {"flash": ("xsct", "openFPGALoader"), "openocd": ("openocd", "openFPGALoader"), "sdcard": ("xsct", "bootgen")}
ENTRY = 0x00100040


def elf(machine: int = 40) -> bytes:
    """Head of a 32-bit program."""
    return b"\x7fELF\x01\x01\x01" + bytes(9) + struct.pack("<HHII", 2, machine, 1, ENTRY) + bytes(24)


@pytest.fixture
def files(tmp_path: Path) -> dict[str, Path]:
    """What the build leaves."""
    found = {name: tmp_path / f"touchdown.{name}" for name in ("bit", "xsa", "elf")}
    found["bit"].write_text("bits")
    found["elf"].write_bytes(elf())
    with zipfile.ZipFile(found["xsa"], "w") as archive:
        archive.writestr("ps7_init.tcl", "proc ps7_init {} {}\n")
    return found


@pytest.fixture
def log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the stand-ins write how they were called; PATH and outputs are the test's own."""
    (tmp_path / "bin").mkdir()
    monkeypatch.setattr("scripts.flash_steps.search_path", lambda: str(tmp_path / "bin"))
    monkeypatch.setattr(flash, "FOLDER", tmp_path / "flash")
    monkeypatch.setattr(sdcard, "FOLDER", tmp_path / "sdcard")
    return tmp_path / "log"


def put(log: Path, *names: str, body: str = "exit 0") -> None:
    """Put stand-ins on the PATH."""
    for name in names:
        tool = log.with_name("bin") / name
        tool.write_text(f'#!/bin/sh\necho "{name} $*" >>{log}\n{body}\n')
        tool.chmod(0o755)


def run(monkeypatch: pytest.MonkeyPatch, main: Callable[[], int], files: dict[str, Path], *arguments: str) -> int:
    named = [word for name, path in files.items() for word in (f"--{name}", str(path))]
    monkeypatch.setattr(sys, "argv", ["make", *named, *arguments])
    return main()


# ---- flash


@pytest.mark.parametrize("tool", ["xsct", "openocd"])
def test_flash_takes_its_steps_in_order(
    tool: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    put(log, tool, "openFPGALoader")
    assert run(monkeypatch, flash.main, files, "--tool", tool) == 0
    first, load, last = log.read_text().splitlines()
    assert load == f"openFPGALoader -b arty_z7_20 {files['bit']}"
    init = log.with_name("flash") / "ps7_init.tcl"
    assert init.read_text() == "proc ps7_init {} {}\n"
    if tool == "xsct":
        assert first == f"xsct scripts/flash/xsct.tcl init {init}"
        assert last == f"xsct scripts/flash/xsct.tcl run {init} {files['elf']}"
    else:
        begin = "openocd -f scripts/flash/cable.tcl -f target/zynq_7000.cfg -f scripts/flash/openocd.tcl -c"
        assert first == f"{begin} ps_init {{{init}}}"
        assert last == f"{begin} ps_run {{{init}}} {{{files['elf']}}} {ENTRY:#010x}"
    assert "The firmware runs." in capsys.readouterr().out


@pytest.mark.parametrize("tool", ["xsct", "openocd"])
def test_a_dry_run_prints_what_a_run_runs(
    tool: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    absent = {name: path.with_suffix(".no") for name, path in files.items()}
    assert run(monkeypatch, flash.main, absent, "--tool", tool, "--dry-run") == 0
    printed = [shlex.split(line) for line in capsys.readouterr().out.splitlines()]
    assert not log.exists()
    put(log, tool, "openFPGALoader")
    assert run(monkeypatch, flash.main, files, "--tool", tool) == 0
    really = [shlex.split(line) for line in capsys.readouterr().out.splitlines()[:3]]
    # Only names of files and where the program starts differ.
    assert [command[0] for command in printed] == [command[0] for command in really]
    assert [len(command) for command in printed] == [len(command) for command in really]


@pytest.mark.parametrize("tool", ["xsct", "openocd"])
def test_flash_without_firmware(
    tool: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    put(log, tool, "openFPGALoader")
    files["elf"].unlink()
    assert run(monkeypatch, flash.main, files, "--tool", tool, "--no-firmware") == 0
    last = log.read_text().splitlines()[2]
    assert last.endswith("ps7_init.tcl" if tool == "xsct" else "ps7_init.tcl}")
    assert "the processor waits" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["bit", "xsa", "elf"])
def test_flash_without_a_file(name: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    put(log, *TOOLS["flash"])
    files[name].unlink()
    maker = {"bit": "make bitstream", "xsa": "make xsa", "elf": "make firmware"}[name]
    with pytest.raises(UserError, match=rf"touchdown\.{name} is not there; run `{maker}` first\.$"):
        run(monkeypatch, flash.main, files)
    assert not log.exists()


@pytest.mark.parametrize("name", ["bit", "xsa", "elf"])
def test_flash_with_an_empty_or_a_wrong_file(
    name: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    put(log, *TOOLS["flash"])
    files[name].write_bytes(b"" if name == "bit" else b"nonsense")
    sentence = {"bit": "is not there", "xsa": r"has no ps7_init\.tcl", "elf": "is no program for a 32-bit ARM"}[name]
    with pytest.raises(UserError, match=sentence):
        run(monkeypatch, flash.main, files)
    assert not log.exists()


def test_flash_with_a_program_for_another_machine(
    log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    put(log, *TOOLS["flash"])
    files["elf"].write_bytes(elf(machine=3))
    with pytest.raises(UserError, match="is no program for a 32-bit ARM"):
        run(monkeypatch, flash.main, files)


@pytest.mark.parametrize(
    ("tools", "sentence"),
    [
        (("xsct",), "openFPGALoader is not on PATH; install Debian's openfpgaloader"),
        (("xsct", "openFPGALoader"), r"xsct is not on PATH; source settings64\.sh of Vitis 2023\.2, or give TOOL="),
        (("openocd", "openFPGALoader"), "openocd is not on PATH; install Debian's openocd"),
    ],
)
def test_flash_without_a_tool(
    tools: tuple[str, ...], sentence: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    # The first is the one that is used for the processor.
    put(log, *tools[1:])
    with pytest.raises(UserError, match=sentence):
        run(monkeypatch, flash.main, files, "--tool", tools[0])
    assert not log.exists()


@pytest.mark.parametrize("broken", ["xsct", "openFPGALoader"])
def test_flash_without_a_board(broken: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    put(log, *TOOLS["flash"])
    put(log, broken, body="echo trying; echo unable to open ftdi device >&2; exit 1")
    with pytest.raises(UserError, match=rf"{broken} failed \(unable to open ftdi device\); connect USB socket J14"):
        run(monkeypatch, flash.main, files)
    assert log.read_text().splitlines()[-1].startswith(broken)


# ---- sdcard

BOOTGEN = 'while [ "$1" != -o ]; do shift; done; echo boot >"$2"'


def test_sdcard_makes_the_boot_loader_and_joins(
    log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    put(log, "xsct")
    put(log, "bootgen", body=BOOTGEN)
    card = tmp_path / "card"
    card.mkdir()
    assert run(monkeypatch, sdcard.main, files, "--card", str(card)) == 0
    folder = tmp_path / "sdcard"
    assert log.read_text().splitlines() == [
        f"xsct scripts/flash/fsbl.tcl {files['xsa']} {folder}",
        f"bootgen -arch zynq -image {folder}/boot.bif -o {folder}/BOOT.BIN -w on",
    ]
    parts = [line.strip() for line in (folder / "boot.bif").read_text().splitlines()]
    fsbl = f"[bootloader] {folder}/touchdown/export/touchdown/sw/touchdown/boot/fsbl.elf"
    assert parts == ["touchdown:", "{", fsbl, str(files["bit"]), str(files["elf"]), "}"]
    assert (card / "BOOT.BIN").read_text() == "boot\n"


def test_sdcard_with_a_boot_loader_needs_no_xsct(
    log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    put(log, "bootgen", body=BOOTGEN)
    (tmp_path / "fsbl.elf").write_bytes(elf())
    files.pop("xsa")
    assert run(monkeypatch, sdcard.main, files, "--fsbl", str(tmp_path / "fsbl.elf")) == 0
    assert f"[bootloader] {tmp_path}/fsbl.elf" in (tmp_path / "sdcard/boot.bif").read_text()


def test_a_dry_run_of_sdcard_needs_nothing(
    log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture, tmp_path: Path
) -> None:
    absent = {name: path.with_suffix(".no") for name, path in files.items()}
    assert run(monkeypatch, sdcard.main, absent, "--dry-run") == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0] == "touchdown:"
    assert [line.split()[0] for line in printed[-2:]] == ["xsct", "bootgen"]
    assert not log.exists()
    assert not (tmp_path / "sdcard").exists()


@pytest.mark.parametrize("name", ["bit", "xsa", "elf"])
def test_sdcard_without_a_file(name: str, log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    put(log, *TOOLS["sdcard"])
    files[name].unlink()
    with pytest.raises(UserError, match=rf"touchdown\.{name} is not there; run `make "):
        run(monkeypatch, sdcard.main, files)


@pytest.mark.parametrize("there", [(), ("xsct",)])
def test_sdcard_without_a_tool(
    there: tuple[str, ...], log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    put(log, *there)
    missing = "bootgen" if there else "xsct"
    with pytest.raises(UserError, match=rf"{missing} is not on PATH; source settings64\.sh of Vitis 2023\.2"):
        run(monkeypatch, sdcard.main, files)


def test_sdcard_when_a_step_fails_or_leaves_nothing(
    log: Path, files: dict[str, Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    put(log, *TOOLS["sdcard"])
    with pytest.raises(UserError, match=r"bootgen left no BOOT\.BIN"):
        run(monkeypatch, sdcard.main, files)
    put(log, "bootgen", body="echo '[ERROR] no such file'; exit 1")
    with pytest.raises(UserError, match=r"bootgen failed \(\[ERROR\] no such file\); see whether"):
        run(monkeypatch, sdcard.main, files)
    put(log, "bootgen", body=BOOTGEN)
    with pytest.raises(UserError, match=r"no/card takes no file .*mount the card's FAT32"):
        run(monkeypatch, sdcard.main, files, "--card", str(tmp_path / "no/card"))


# ---- What the tools run.

RECORDED = ("connect", "targets", "rst", "dow", "con", "disconnect", "after", "init", "halt", "mww", "load_image")
RECORDED += ("resume", "shutdown", "platform", "exec", "adapter", "ftdi", "reset_config")


def tcl(script: str, argv: list[str], body: str, tmp_path: Path) -> list[str]:
    """Run a script with commands of its tool that print how they are called."""
    ps7_init = tmp_path / "ps7_init.tcl"
    ps7_init.write_text("proc ps7_init {} {puts ps7_init}\nproc ps7_post_config {} {puts ps7_post_config}\n")
    stubs = "\n".join(f"proc {name} {{args}} {{puts [list {name} {{*}}$args]}}" for name in RECORDED)
    main = tmp_path / "main.tcl"
    main.write_text(
        f"{stubs}\nproc read_memory {{args}} {{return 0x12345678}}\n"
        f"set argv [list {' '.join(argv)}]\nsource {SCRIPTS / script}\n{body}\n"
    )
    run = subprocess.run([need("tclsh"), main], cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


def test_xsct_resets_before_the_bitstream_and_starts_after_it(tmp_path: Path) -> None:
    init = str(tmp_path / "ps7_init.tcl")
    first = tcl("xsct.tcl", ["init", init], "", tmp_path)
    assert first.index("rst -system") < first.index("ps7_init")
    last = tcl("xsct.tcl", ["run", init, "a.elf"], "", tmp_path)
    assert "rst -system" not in last
    assert "dow" not in " ".join(tcl("xsct.tcl", ["run", init], "", tmp_path))
    order = [last.index(line) for line in ("ps7_post_config", "rst -processor", "dow a.elf", "con")]
    assert order == sorted(order)


@pytest.mark.parametrize("step", ["init", "run"])
def test_xsct_leaves_the_cable_to_the_next_tool(step: str, tmp_path: Path) -> None:
    """Its server is one of its own, and has ended before the script does."""
    calls = tcl("xsct.tcl", [step, str(tmp_path / "ps7_init.tcl")], "", tmp_path)
    (server,) = [call for call in calls if call.startswith("exec hw_server ")]
    place, idle_s = re.fullmatch(r"exec hw_server -d -s (\S+) -p0 -I(\d+)", server).groups()
    assert f"connect -url {place}" in calls
    assert calls[-2] == "disconnect"
    assert int(calls[-1].removeprefix("after ")) > 1000 * int(idle_s)


def test_xsct_selects_the_processor_anew_after_its_reset(tmp_path: Path) -> None:
    calls = tcl("xsct.tcl", ["init", str(tmp_path / "ps7_init.tcl")], "", tmp_path)
    reset = calls.index("rst -system")
    assert calls[reset + 1 : reset + 3] == ["after 3000", calls[reset - 1]]
    assert calls[reset - 1].startswith("targets -set ")


def test_the_cable_is_found_whatever_its_name(tmp_path: Path) -> None:
    assert tcl("cable.tcl", [], "", tmp_path)[:2] == ["adapter driver ftdi", "ftdi vid_pid 0x0403 0x6010"]


def test_openocd_answers_as_xsct_does(tmp_path: Path) -> None:
    # ps7_init.tcl takes the digits from the end of the line.
    said = tcl("openocd.tcl", [], "puts [string range [mrd -force 0xF8007080] end-8 end]", tmp_path)
    assert said[0] == "12345678"
    assert tcl("openocd.tcl", [], "mwr -force 0xF8000008 0xDF0D", tmp_path) == ["mww 0xF8000008 0xDF0D"]
    first = tcl("openocd.tcl", [], f"ps_init {tmp_path / 'ps7_init.tcl'}", tmp_path)
    assert first == ["init", "targets zynq.cpu0", "halt", "ps7_init", "shutdown"]
    waiting = tcl("openocd.tcl", [], f"ps_run {tmp_path / 'ps7_init.tcl'}", tmp_path)
    assert waiting[3:] == ["ps7_post_config", "shutdown"]
    last = tcl("openocd.tcl", [], f"ps_run {tmp_path / 'ps7_init.tcl'} a.elf 0x00100040", tmp_path)
    assert last[3:] == ["ps7_post_config", "load_image a.elf", "resume 0x00100040", "shutdown"]


def test_the_boot_loader_is_made_of_the_hardware(tmp_path: Path) -> None:
    create, generate = tcl("fsbl.tcl", ["a.xsa", "out"], "", tmp_path)
    assert create == "platform create -name touchdown -hw a.xsa -proc ps7_cortexa9_0 -os standalone -out out"
    assert generate == "platform generate"
    assert sdcard.FSBL.startswith("touchdown/export/touchdown/")
