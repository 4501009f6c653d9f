# SPDX-License-Identifier: Apache-2.0
"""display: each view with each drawing, missing frames, a pixel clock that stops, registers, the board's pins."""

from dataclasses import replace
from random import Random

import cocotb
from cocotb.handle import HierarchyObject
from cocotb.triggers import ClockCycles
from cocotbext.axi import AxiResp

from golden import registers as golden
from golden.display import VIEWS, display
from golden.generated import display_regs as regs
from golden.overlay import Drawing
from tb.common.axi_lite import check_responses
from tb.common.run import where
from tb.display.tb_display import CLK_PER_US, MAX_HEIGHT, MAX_WIDTH, Bench, Pictures, random_drawing

# With a faster one streams fall behind within a line, as the page of video_out says.
PIX_NS = {"720p": 13.468, "half": 20.0}
TEXT = ("DESCEND", "x -12 y +7 mm  alt 1.204 m")
PUSHED = {regs.EVENTS_STORED_UNDERFLOW_MASK: "stored_underflow", regs.EVENTS_STORED_ERROR_MASK: "stored_error"}


def sizes(rng: Random) -> tuple[int, int]:
    """A frame's width and height."""
    return rng.choice([(MAX_WIDTH, MAX_HEIGHT), (rng.randint(1, MAX_WIDTH), rng.randint(1, MAX_HEIGHT)), (1, 1)])


@cocotb.test()
@cocotb.parametrize((("pix", "view"), [*(("720p", view) for view in range(len(VIEWS))), ("half", 3)]))
async def each_view(dut: HierarchyObject, pix: str, view: int) -> None:
    """Frames of one view, drawn over, each with its own drawing."""
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    await bench.set_view(view)
    for _ in range(2):
        size, drawing = sizes(bench.rng), random_drawing(bench.rng)
        await bench.draw(drawing)
        frames = [Pictures.random(bench.rng, *size) for _ in range(2)]
        await bench.play(frames)
        bench.monitor.check([display(view, one.rgb, one.gray, one.binary, drawing) for one in frames])
    assert await bench.read(regs.FRAMES_BLANK_OFFSET) == 0, f"a frame was blank; {where()}"


@cocotb.test()
async def views_change_between_frames(dut: HierarchyObject) -> None:
    """Whenever the CPU writes it, the view changes with a frame, and no frame is torn or blank."""
    bench = Bench(dut)
    await bench.reset()
    drawing = Drawing(boxes=((2, 2, 30, 12), (5, 4, 12, 10), None, None))
    await bench.draw(drawing)
    frames = [Pictures.random(bench.rng, 37, 15) for _ in range(12)]
    playing = cocotb.start_soon(bench.play(frames))
    while not playing.done():
        await bench.set_view(bench.rng.randrange(4))
        await ClockCycles(dut.clk, bench.rng.randint(1, 1200))
    seen = set()
    for index, (got, one) in enumerate(zip(bench.monitor.frames, frames, strict=True)):
        views = [display(view, one.rgb, one.gray, one.binary, drawing).ravel().tolist() for view in range(4)]
        # The tint comes with the frame, the view with the camera's frame: between them the CPU may have written.
        views.append(display(2, one.rgb, one.gray, one.binary, drawing).ravel().tolist())
        assert got in views, f"frame {index} is none of the views; {where()}"
        seen.add(views.index(got))
    assert len(seen) > 2, f"only the views {seen} were seen; {where()}"


@cocotb.test()
async def text_goes_to_either_bank(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    await bench.reset()
    for bank, words in ((1, TEXT), (0, (TEXT[1], TEXT[0])), (1, TEXT)):
        drawing = replace(random_drawing(bench.rng), text=words)
        await bench.draw(drawing, bank)
        frames = [Pictures.random(bench.rng, MAX_WIDTH, MAX_HEIGHT)]
        await bench.play(frames)
        bench.monitor.check([display(0, one.rgb, one.gray, one.binary, drawing) for one in frames])


@cocotb.test()
async def frames_without_pixels_are_counted(dut: HierarchyObject) -> None:
    """A frame of which no stream shows anything is blank, told once and counted; the one after it is whole."""
    bench = Bench(dut)
    await bench.reset()
    await bench.draw(Drawing())
    # The delay is shorter than this frame, so that a frame is not taken for the one before it.
    frames = [Pictures.random(bench.rng, MAX_WIDTH, MAX_HEIGHT) for _ in range(5)]
    await bench.play(frames, missing=(1, 3))
    bench.monitor.check([None if index in (1, 3) else one.rgb for index, one in enumerate(frames)])
    assert await bench.read(regs.FRAMES_BLANK_OFFSET) == 2, where()
    assert await bench.read(regs.EVENTS_OFFSET) == regs.EVENTS_FRAME_BLANK_MASK, where()
    await bench.write(regs.EVENTS_OFFSET, regs.EVENTS_FRAME_BLANK_MASK)
    assert await bench.read(regs.EVENTS_OFFSET) == 0, where()


@cocotb.test()
@cocotb.parametrize(pix=list(PIX_NS))
async def the_pixel_clock_is_measured(dut: HierarchyObject, pix: str) -> None:
    """Its kHz to within a step; it stops, is missed, comes back, and the next frame is whole."""
    bench = Bench(dut, PIX_NS[pix])
    await bench.reset()
    await bench.draw(Drawing())
    ms = 1000 * CLK_PER_US
    await ClockCycles(dut.clk, 2 * ms + 20)
    # The bench's clk is CLK_PER_US cycles a microsecond to the core, whatever its period.
    expected = 1000 * CLK_PER_US * 10.0 / (round(PIX_NS[pix] / 2, 3) * 2)
    got = await bench.read(regs.PIX_CLK_OFFSET)
    assert abs(got - expected) <= 17, f"{got} kHz, expected {expected:.0f}; {where()}"
    assert await bench.read(regs.STATUS_OFFSET) == regs.STATUS_CLOCK_RUNS_MASK, where()
    assert await bench.read(regs.EVENTS_OFFSET) == 0, where()
    bench.pix_clock.stop()
    await ClockCycles(dut.clk, 2 * ms + 20)
    assert await bench.read(regs.PIX_CLK_OFFSET) == 0, where()
    assert await bench.read(regs.STATUS_OFFSET) == 0, where()
    assert await bench.read(regs.EVENTS_OFFSET) == regs.EVENTS_CLOCK_LOST_MASK, where()
    await bench.write(regs.EVENTS_OFFSET, regs.EVENTS_CLOCK_LOST_MASK)
    await ClockCycles(dut.clk, 2 * ms)
    assert await bench.read(regs.EVENTS_OFFSET) == 0, f"a clock that stays away is lost again; {where()}"
    bench.pix_clock.start(start_high=False)
    await ClockCycles(dut.clk, 2 * ms)
    assert await bench.read(regs.STATUS_OFFSET) == regs.STATUS_CLOCK_RUNS_MASK, where()
    frames = [Pictures.random(bench.rng, 12, 8) for _ in range(2)]
    await bench.play(frames)
    bench.monitor.check([one.rgb for one in frames])


@cocotb.test()
async def the_board_is_seen(dut: HierarchyObject) -> None:
    """Inputs in STATUS and EVENTS, registers at the outputs."""
    bench = Bench(dut)
    await bench.reset()
    for _ in range(8):
        inputs = {name: bench.rng.getrandbits(bits) for name, bits in BOARD.items()}
        for name, value in inputs.items():
            getattr(dut, name).value = value
        await ClockCycles(dut.clk, 4)
        status = await bench.read(regs.STATUS_OFFSET) & ~regs.STATUS_CLOCK_RUNS_MASK
        wanted = inputs["pix_clk_locked"] << regs.STATUS_CLOCK_LOCKED_SHIFT
        wanted |= inputs["monitor_present"] << regs.STATUS_MONITOR_SHIFT
        wanted |= inputs["buttons"] << regs.STATUS_BUTTONS_SHIFT | inputs["switches"] << regs.STATUS_SWITCHES_SHIFT
        assert status == wanted, f"STATUS {status:#x}, expected {wanted:#x}; {where()}"
    for mask, name in PUSHED.items():
        getattr(dut, name).value = 1
        await ClockCycles(dut.clk, 1)
        getattr(dut, name).value = 0
        await ClockCycles(dut.clk, 1)
        assert await bench.read(regs.EVENTS_OFFSET) == mask, where()
        await bench.write(regs.EVENTS_OFFSET, mask)
    for register in (regs.CTRL_OFFSET, regs.LEDS_OFFSET, regs.STORED_BASE_OFFSET) * 4:
        value = bench.rng.getrandbits(32)
        await bench.write(register, value)
        outputs = {
            regs.CTRL_OFFSET: (int(dut.source.value), int(dut.pattern_move.value)),
            regs.LEDS_OFFSET: int(dut.leds.value),
            regs.STORED_BASE_OFFSET: int(dut.stored_base.value),
        }
        wanted = {regs.CTRL_OFFSET: (value & 3, value >> 8 & 1), regs.LEDS_OFFSET: value & 15}
        assert outputs[register] == wanted.get(register, value), f"{register:#x} = {value:#x}; {where()}"


BOARD = {"pix_clk_locked": 1, "monitor_present": 1, "buttons": 4, "switches": 2}


@cocotb.test()
async def registers_are_those_of_the_source(dut: HierarchyObject) -> None:
    """Reset values, each bit alone, random strobes, addresses between and beyond; the slave is landing_regs' twin."""
    bench = Bench(dut)
    check_responses(dut)
    await bench.reset()
    bench.pix_clock.stop()
    state = golden.reset_state(regs.REGISTERS)
    accesses = [(register.offset, 1 << bit, 4) for register in regs.REGISTERS for bit in range(32)]
    # The bytes that are not written are 0 on the bus.
    for register in regs.REGISTERS:
        for length in (1, 2, 3):
            accesses += [(register.offset, 0xFFFFFFFF, 4), (register.offset, 0, length)]
    addresses = [*state, 0x54, 0x7C, 0x800, 0xFFC]
    accesses += [(bench.rng.choice(addresses), bench.rng.getrandbits(32), bench.rng.randint(1, 4)) for _ in range(200)]
    for register in regs.REGISTERS:
        got = await bench.read(register.offset)
        assert got == state[register.offset], f"{register.name} is {got:#x} after reset; {where()}"
    for address, data, length in accesses:
        response = await bench.cpu.write(address, data.to_bytes(4, "little")[:length])
        state, expected = golden.write(regs.REGISTERS, state, address, data, (1 << length) - 1)
        assert response.resp == AxiResp(expected), f"write to {address:#x}: {response.resp}; {where()}"
        answer = await bench.cpu.read(address, 4)
        word, expected = golden.read(regs.REGISTERS, state, address, {})
        got = (int.from_bytes(answer.data, "little"), answer.resp)
        assert got == (word, AxiResp(expected)), f"read of {address:#x}: {got}, expected {word:#x}; {where()}"


@cocotb.test()
async def a_write_does_not_wait_for_ready(dut: HierarchyObject) -> None:
    """It counts while its response waits, and the next one only when that has been taken."""
    bench = Bench(dut)
    check_responses(dut)
    await bench.reset()
    responses = bench.cpu.write_if.b_channel
    for first, second in ((5, 10), (9, 6)):
        responses.pause = True
        writes = [cocotb.start_soon(bench.write(regs.LEDS_OFFSET, value)) for value in (first, second)]
        await ClockCycles(dut.clk, 40)
        assert int(dut.leds.value) == first, f"leds {int(dut.leds.value)}, expected {first}; {where()}"
        responses.pause = False
        for write in writes:
            await write
        assert int(dut.leds.value) == second, f"leds {int(dut.leds.value)}, expected {second}; {where()}"


@cocotb.test()
async def reset_in_mid_frame_forgets_the_drawing(dut: HierarchyObject) -> None:
    bench = Bench(dut)
    for _ in range(3):
        await bench.reset()
        await bench.set_view(1)
        await bench.draw(replace(random_drawing(bench.rng), crosshair=True))
        playing = cocotb.start_soon(bench.play([Pictures.random(bench.rng, 20, 10) for _ in range(3)]))
        await ClockCycles(dut.clk, bench.rng.randint(1, 2500))
        playing.cancel()
        bench.stop()
        await bench.reset()
        frames = [Pictures.random(bench.rng, 20, 10) for _ in range(2)]
        await bench.play(frames)
        bench.monitor.check([display(0, one.rgb, one.gray, one.binary, Drawing(crosshair=True)) for one in frames])
