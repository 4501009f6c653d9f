# SPDX-License-Identifier: Apache-2.0
"""overlay: drawings, when they are sampled, text, the frame contract, latency."""

from random import Random, getrandbits

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge

from golden.overlay import COLUMNS, LINES, Drawing, overlay
from tb.common.contract import SizeLimits
from tb.common.figures import page_figures
from tb.common.matrix import SCENES, STALLS, VideoCore, named, send_and_check, start
from tb.common.patterns import random_frame
from tb.common.run import parameter, where
from tb.common.stream import Beat, StreamBench, frame_beats

LIMITS = SizeLimits(1, 1, parameter("MAX_WIDTH", 1280), parameter("MAX_HEIGHT", 720))
LEAST, MOST = -8192, 8191
(LATENCY,) = page_figures("overlay")


def place(rng: Random) -> int:
    """A coordinate: in a small frame, at its edges, a little or far outside."""
    return rng.choice([rng.randint(-3, 20), rng.randint(-3, 20), rng.randint(-80, 90), rng.choice([LEAST, MOST, 0])])


def drawing_of(first_pixel: int) -> Drawing:
    """The drawing that goes with a frame, so that model and bench agree without talking."""
    rng = Random(first_pixel)
    boxes = tuple(tuple(place(rng) for _ in range(4)) if rng.random() < 0.6 else None for _ in range(4))
    centre = (place(rng), place(rng)) if rng.random() < 0.7 else None
    # A mark as large as the frame would hide what is behind it.
    if centre and rng.random() < 0.5:
        centre = (min(centre[0] + 30, MOST), max(centre[1] - 30, LEAST))
    text = rng.choice(TEXTS) if rng.random() < 0.3 else None
    return Drawing(boxes, centre, (place(rng), place(rng)), rng.random() < 0.3, rng.random() < 0.4, text)


def random_text(seed: int) -> tuple[str, ...]:
    """All characters, in lines."""
    rng = Random(seed)
    return tuple("".join(chr(rng.randrange(128)) for _ in range(COLUMNS)) for _ in range(LINES))


TEXTS = (random_text(7), random_text(8))
"""What the two banks hold."""
CORE = VideoCore(golden=lambda image: overlay(image, drawing_of(int(image[0, 0]))), bits_in=24, reach=0, limits=LIMITS)


def show(dut: HierarchyObject, drawing: Drawing) -> None:
    """Put a drawing on the inputs; what is not shown is noise."""
    corners = [box or [getrandbits(13) for _ in range(4)] for box in drawing.boxes]
    values = [value & 0x3FFF for box in corners for value in box]
    dut.cfg_boxes.value = sum(value << 14 * index for index, value in enumerate(values))
    dut.cfg_show_boxes.value = sum((box is not None) << index for index, box in enumerate(drawing.boxes))
    centre = drawing.centre or (getrandbits(13), getrandbits(13))
    dut.cfg_centre_x.value, dut.cfg_centre_y.value = (value & 0x3FFF for value in centre)
    dut.cfg_tip_x.value, dut.cfg_tip_y.value = (value & 0x3FFF for value in drawing.tip)
    dut.cfg_show_pad.value = drawing.centre is not None
    dut.cfg_show_crosshair.value = drawing.crosshair
    dut.cfg_tint.value = drawing.tint
    dut.cfg_show_text.value = drawing.text is not None
    dut.cfg_text_bank.value = TEXTS.index(drawing.text) if drawing.text in TEXTS else getrandbits(1)


async def write_text(dut: HierarchyObject, bank: int, text: tuple[str, ...]) -> None:
    """Write all characters of a bank."""
    dut.text_write.value = 1
    for line, words in enumerate(text):
        for column, char in enumerate(words):
            dut.text_address.value = (bank * LINES + line) * COLUMNS + column
            dut.text_char.value = ord(char)
            await RisingEdge(dut.clk)
    dut.text_write.value = 0


async def begin(dut: HierarchyObject, rng: Random, stall: str) -> StreamBench:
    """A bench after reset whose frames each bring their own drawing; with the second pixel another is offered."""
    dut.text_write.value = 0
    dut.cfg_hold.value = 0
    show(dut, Drawing())
    bench = await start(dut, rng, stall)
    set_size = bench.source.on_beat

    was_first = False

    def on_beat(beat: Beat) -> None:
        nonlocal was_first
        set_size(beat)
        if beat.user or was_first:
            show(dut, drawing_of(beat.data if beat.user else rng.getrandbits(24)))
        was_first = bool(beat.user)

    bench.source.on_beat = on_beat
    for bank, text in enumerate(TEXTS):
        await write_text(dut, bank, text)
    return bench


@cocotb.test()
@cocotb.parametrize(scene=named(SCENES), stall=named(STALLS))
async def frame_contract(dut: HierarchyObject, scene: str, stall: str) -> None:
    rng = Random(f"{scene} {getrandbits(64)}")
    bench = await begin(dut, rng, stall)
    await send_and_check(bench, CORE, SCENES[scene](rng, CORE))


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def every_shape(dut: HierarchyObject, stall: str) -> None:
    """Frames large enough for the arms of the marks and for letters."""
    rng = Random(getrandbits(64))
    bench = await begin(dut, rng, stall)
    width, height = min(LIMITS.max_width, 90), min(LIMITS.max_height, 36)
    for _ in range(6 if stall == "full_speed" else 2):
        await send_and_check(bench, CORE, frame_beats(random_frame(rng, width, height, 24)))
        bench.sink.taken.clear()


@cocotb.test(skip=LIMITS.max_height < 90)
async def crosshair_to_its_ends(dut: HierarchyObject) -> None:
    bench = await begin(dut, Random(getrandbits(64)), "full_speed")
    frame = random_frame(bench.rng, 87, 90, 24)
    frame[0, 0] = next(p for p in range(1 << 24) if drawing_of(p).crosshair and not any(drawing_of(p).boxes))
    await send_and_check(bench, CORE, frame_beats(frame))


def showing(bench: StreamBench, drawing: Drawing) -> VideoCore:
    """Let all frames from now on offer a drawing; the core that draws it."""
    bench.source.on_beat = lambda beat: (bench._set_size(beat), show(bench.dut, drawing) if beat.user else None)
    return VideoCore(lambda image: overlay(image, drawing), 24, 0, LIMITS)


@cocotb.test()
async def every_letter(dut: HierarchyObject) -> None:
    """All 128 codes, on lines as wide as the frame can be."""
    bench = await begin(dut, Random(getrandbits(64)), "full_speed")
    codes = "".join(chr(code) for code in range(128))
    text = (codes[:COLUMNS], codes[COLUMNS:])
    for bank in range(2):
        await write_text(dut, bank, text)
    size = min(LIMITS.max_width, COLUMNS * 16 + 3), min(LIMITS.max_height, LINES * 16 + 2)
    await send_and_check(bench, showing(bench, Drawing(text=text)), frame_beats(random_frame(bench.rng, *size, 24)))


@cocotb.test()
async def a_bank_is_written_while_the_other_is_shown(dut: HierarchyObject) -> None:
    bench = await begin(dut, Random(getrandbits(64)), "full_speed")
    size = min(LIMITS.max_width, 90), min(LIMITS.max_height, 36)
    beats = frame_beats(random_frame(bench.rng, *size, 24))
    writing = cocotb.start_soon(write_text(dut, 1, TEXTS[0]))
    await send_and_check(bench, showing(bench, Drawing(text=TEXTS[0])), beats)
    await writing
    bench.sink.taken.clear()
    showing(bench, Drawing(text=TEXTS[1]))
    # The other bank holds by now what the first does.
    core = VideoCore(lambda image: overlay(image, Drawing(text=TEXTS[0])), 24, 0, LIMITS)
    await send_and_check(bench, core, beats)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def held_drawing_stays(dut: HierarchyObject, stall: str) -> None:
    """Held, a frame shows what was sampled last, by one that was cut off or malformed too; after a reset nothing."""
    rng = Random(getrandbits(64))
    bench = await begin(dut, rng, stall)
    for _ in range(3):
        await bench.reset()
        shown, expected, beats, held = Drawing(), {}, [], {}
        for index in range(24):
            size = rng.choice([(1, 1), (2, 1), (1, 2), (3, 2), (17, 11), (12, 9)])
            frame = random_frame(rng, *size, 24)
            first = int(frame[0, 0])
            held[first] = index == 0 or rng.random() < 0.5
            shown = shown if held[first] else drawing_of(first)
            expected[first] = shown
            whole = frame_beats(frame)
            malformed = [whole[0]._replace(last=1 - whole[0].last)]
            cut = whole[: rng.randint(1, len(whole))]
            beats += rng.choices([whole, cut, malformed], [0.5, 0.3, 0.2])[0]
        await _send_held(bench, beats, held, expected)
        bench.sink.taken.clear()


async def _send_held(
    bench: StreamBench, beats: list[Beat], held: dict[int, bool], expected: dict[int, Drawing]
) -> None:
    """Send frames that each offer a drawing; whether it is held, and what is shown, goes by their first pixel."""

    def on_beat(beat: Beat) -> None:
        bench._set_size(beat)
        if beat.user:
            show(bench.dut, drawing_of(beat.data))
            bench.dut.cfg_hold.value = held[beat.data]

    bench.source.on_beat = on_beat
    core = VideoCore(lambda image: overlay(image, expected[int(image[0, 0])]), 24, 0, LIMITS)
    await send_and_check(bench, core, beats)


@cocotb.test()
@cocotb.parametrize(stall=named(STALLS))
async def reset_within_a_frame(dut: HierarchyObject, stall: str) -> None:
    rng = Random(getrandbits(64))
    bench = await begin(dut, rng, stall)
    for _ in range(5):
        bench.source.send_beats(frame_beats(random_frame(rng, 17, 11, 24)))
        await bench.cycles(rng.randint(1, 250))
        await bench.reset(rng.randint(1, 3))
        await send_and_check(bench, CORE, frame_beats(random_frame(rng, 9, 5, 24)) * 2)


@cocotb.test()
async def reset_forgets_a_drawing_on_its_way(dut: HierarchyObject) -> None:
    """A reset of one clock, however far the first pixel has got, and a frame that holds: nothing is drawn."""
    bench = await begin(dut, Random(getrandbits(64)), "full_speed")
    everything = Drawing(((0, 0, 9, 9),) * 4, (4, 4), (8, 2), crosshair=True, tint=True, text=TEXTS[0])
    frame = frame_beats(random_frame(bench.rng, 12, 9, 24))
    nothing = VideoCore(lambda image: image, 24, 0, LIMITS)
    for clocks in range(10):
        dut.cfg_hold.value = 0
        showing(bench, everything)
        bench.source.send_beats(frame)
        await bench.cycles(clocks)
        await bench.reset(1)
        dut.cfg_hold.value = 1
        await send_and_check(bench, nothing, frame)


@cocotb.test()
async def latency(dut: HierarchyObject) -> None:
    bench = await begin(dut, Random(getrandbits(64)), "full_speed")
    beats = frame_beats(random_frame(bench.rng, 16, 4, 24)) * 2
    await send_and_check(bench, CORE, beats)
    delays = {out.cycle - into.cycle for into, out in zip(bench.input.taken, bench.sink.taken, strict=True)}
    assert delays == {LATENCY}, f"latencies {delays}, documented {LATENCY}; {where()}"
    cycles = bench.input.taken[-1].cycle - bench.input.taken[0].cycle + 1
    assert cycles == len(beats), f"{len(beats)} pixels took {cycles} cycles; {where()}"
