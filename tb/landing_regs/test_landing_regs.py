# SPDX-License-Identifier: Apache-2.0
"""landing_regs against `golden.landing_regs`, through the AXI4-Lite master of cocotbext-axi and by hand."""

from random import Random, getrandbits
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import Combine, RisingEdge, Timer
from cocotbext.axi import AxiLiteBus, AxiLiteMaster

from golden import landing_regs as golden
from golden.generated import landing_regs as regs
from tb.common.axi_lite import check_responses
from tb.common.figures import page_figures
from tb.common.run import where
from tb.common.stream import CLOCK_NS, stalls

UNMAPPED = [0x64, 0x68, 0x7C, 0x80, 0x100, 0x400, 0x7FC, 0x800, 0xFFC]
LIMIT_US = 300  # of simulated time; no test comes near


class Bench:
    """Clock, reset, AXI4-Lite master, random hardware inputs, and a checker of the response channels."""

    def __init__(self, dut: HierarchyObject, rng: Random) -> None:
        self.dut, self.rng = dut, rng
        self.state = golden.reset_state()
        self.inputs: dict[int, int] = {}
        dut.rst.value = 1
        cocotb.start_soon(Clock(dut.clk, CLOCK_NS, unit="ns").start())
        self.master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.clk, dut.rst)
        write, read = self.master.write_if, self.master.read_if
        self.channels = (write.aw_channel, write.w_channel, write.b_channel, read.ar_channel, read.r_channel)
        for channel in self.channels:
            channel.queue_occupancy_limit = -1  # here the tests queue and take transfers themselves
        for field in _status_fields():
            getattr(dut, f"irq_status_{field}_set").value = 0
        self.drive_inputs()
        check_responses(dut)

    async def reset(self) -> None:
        """Reset the registers."""
        self.dut.rst.value = 1
        for _ in range(3):
            await RisingEdge(self.dut.clk)
        self.dut.rst.value = 0
        await RisingEdge(self.dut.clk)
        self.state = golden.reset_state()

    def drive_inputs(self) -> None:
        """Put new random values on every hardware input."""
        for register in regs.REGISTERS:
            word = 0
            for field in register.fields:
                if field.access == "ro":
                    value = self.rng.getrandbits(field.width)
                    getattr(self.dut, f"{register.name}_{field.name}".lower()).value = value
                    word |= value << field.lsb
            self.inputs[register.offset] = word

    def stall(self, fraction: float) -> None:
        """Pause every channel of the master in `fraction` of the cycles, independently."""
        for channel in self.channels:
            channel.set_pause_generator(stalls(self.rng, fraction))

    async def write(self, address: int, data: int, strobes: int = 0xF) -> None:
        """Write, and compare the response with the golden one."""
        await self.send_write(address, data, strobes)
        self.state, expected = golden.write(self.state, address, data, strobes)
        got = await self.take_write()
        assert got == expected, f"write 0x{address:x}: expected response {expected}, got {got}; {where()}"

    async def send_write(self, address: int, data: int, strobes: int = 0xF) -> None:
        """Queue address and data."""
        channel = self.master.write_if
        await channel.aw_channel.send(channel.aw_channel._transaction_obj(awaddr=address, awprot=0))
        await channel.w_channel.send(channel.w_channel._transaction_obj(wdata=data, wstrb=strobes))

    async def take_write(self) -> int:
        """Return the next write response."""
        return int((await self.master.write_if.b_channel.recv()).bresp)

    async def read(self, address: int) -> int:
        """Read, and compare data and response with the golden ones."""
        channel = self.master.read_if
        await channel.ar_channel.send(channel.ar_channel._transaction_obj(araddr=address, arprot=0))
        item = await channel.r_channel.recv()
        self.state, data, response = golden.read(self.state, address, self.inputs)
        got = (int(item.rdata), int(item.rresp))
        assert got == (data, response), (
            f"read 0x{address:x}: expected data 0x{data:08x}, response {response}; "
            f"got 0x{got[0]:08x}, {got[1]}; {where()}"
        )
        return data

    async def settle(self) -> None:
        """Wait until the interrupt output has followed."""
        for _ in range(3):
            await RisingEdge(self.dut.clk)

    def check_outputs(self) -> None:
        """Assert every configuration output and the interrupt."""
        for register in regs.REGISTERS:
            for field in register.fields:
                port = f"{register.name}_{field.name}".lower()
                if field.access == "rw" and hasattr(self.dut, port):
                    expected = self.state[register.offset] >> field.lsb & ((1 << field.width) - 1)
                    got = int(getattr(self.dut, port).value)
                    assert got == expected, f"output {port}: expected 0x{expected:x}, got 0x{got:x}; {where()}"
        self.check_irq()

    def check_irq(self) -> None:
        """Assert the interrupt."""
        expected, got = int(golden.interrupt(self.state)), int(self.dut.irq.value)
        assert got == expected, f"irq: expected {expected}, got {got}; {where()}"


async def _clocks_until(dut: HierarchyObject, inputs: list[Any], output: Any) -> int:
    """Clear the inputs after one edge; return the number of edges that the output takes to rise, that one included."""
    for clocks in range(1, 10):
        await RisingEdge(dut.clk)
        for signal in inputs:
            signal.value = 0
        await Timer(1, "ns")
        if int(output.value):
            return clocks
    raise AssertionError(f"{output._name} does not rise; {where()}")


def _status_fields() -> list[str]:
    return [field.name for field in golden.IRQ_STATUS.fields]


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def reset_values(dut: HierarchyObject) -> None:
    """Every register after reset, and again after changes and a reset in between."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    for register in regs.REGISTERS:
        await bench.read(register.offset)
    bench.check_outputs()
    for register in regs.REGISTERS:
        await bench.write(register.offset, bench.rng.getrandbits(32))
    await bench.reset()
    for register in regs.REGISTERS:
        await bench.read(register.offset)
    bench.check_outputs()


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(stalled=[0.0, 0.5])
async def random_accesses(dut: HierarchyObject, stalled: float) -> None:
    """Reads and writes of mapped and unmapped, aligned and unaligned addresses with random strobes."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.stall(stalled)
    for _ in range(600):
        address = bench.rng.choice([register.offset for register in regs.REGISTERS] * 2 + UNMAPPED)
        address += bench.rng.choice([0, 0, 0, 1, 2, 3])
        if bench.rng.random() < 0.5:
            await bench.write(address, bench.rng.getrandbits(32), bench.rng.getrandbits(4))
        else:
            await bench.read(address)
        if bench.rng.random() < 0.1:
            await bench.settle()
            bench.check_outputs()
            bench.drive_inputs()
            await bench.settle()


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def every_bit_of_every_register(dut: HierarchyObject) -> None:
    """Each bit alone written and read back, so that no two fields are crossed."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    for register in regs.REGISTERS:
        for bit in range(32):
            await bench.write(register.offset, 1 << bit)
            await bench.read(register.offset)
            await bench.settle()
            bench.check_outputs()


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(lead=[-5, -1, 0, 1, 5])
async def address_and_data_in_any_order(dut: HierarchyObject, lead: int) -> None:
    """The data comes `lead` clocks after the address (before it, if negative)."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    channel = bench.master.write_if

    async def delayed(clocks: int, which: str, transaction: object) -> None:
        for _ in range(clocks):
            await RisingEdge(dut.clk)
        await getattr(channel, which).send(transaction)

    for _ in range(10):
        data = bench.rng.getrandbits(32)
        address = channel.aw_channel._transaction_obj(awaddr=regs.SCRATCH_OFFSET, awprot=0)
        payload = channel.w_channel._transaction_obj(wdata=data, wstrb=0xF)
        await Combine(
            cocotb.start_soon(delayed(max(0, -lead), "aw_channel", address)),
            cocotb.start_soon(delayed(max(0, lead), "w_channel", payload)),
        )
        assert await bench.take_write() == golden.OKAY
        bench.state, _ = golden.write(bench.state, regs.SCRATCH_OFFSET, data, 0xF)
        await bench.read(regs.SCRATCH_OFFSET)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(stalled=[0.0, 0.5])
async def back_to_back(dut: HierarchyObject, stalled: float) -> None:
    """Queued writes and reads at once: every response in order, and at full speed one in two clocks."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    bench.stall(stalled)
    writes = [(bench.rng.choice([regs.SCRATCH_OFFSET, 0x64]), bench.rng.getrandbits(32)) for _ in range(40)]
    reads = [bench.rng.choice([regs.ID_OFFSET, regs.VERSION_OFFSET, 0x64]) for _ in range(40)]
    channel = bench.master.read_if
    begin = cocotb.utils.get_sim_time("ns")
    for address, data in writes:
        await bench.send_write(address, data)
    for address in reads:
        await channel.ar_channel.send(channel.ar_channel._transaction_obj(araddr=address, arprot=0))
    for address, data in writes:
        bench.state, expected = golden.write(bench.state, address, data, 0xF)
        got = await bench.take_write()
        assert got == expected, f"write response: expected {expected}, got {got}; {where()}"
    for address in reads:
        item = await channel.r_channel.recv()
        _, data, response = golden.read(bench.state, address, bench.inputs)
        got = (int(item.rdata), int(item.rresp))
        assert got == (data, response), f"read 0x{address:x}: expected {(data, response)}, got {got}; {where()}"
    clocks = (cocotb.utils.get_sim_time("ns") - begin) / CLOCK_NS
    assert stalled or clocks <= 2 * len(writes) + 6, f"{len(writes)} writes took {clocks} clocks; {where()}"
    await bench.read(regs.SCRATCH_OFFSET)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def latency(dut: HierarchyObject) -> None:
    """Clocks from an address taken to its data, from address and data to the response, and from status to `irq`."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    await bench.write(regs.IRQ_ENABLE_OFFSET, 1)
    dut.s_axil_araddr.value, dut.s_axil_arvalid.value = regs.ID_OFFSET, 1
    read = await _clocks_until(dut, [dut.s_axil_arvalid], dut.s_axil_rvalid)
    dut.s_axil_awaddr.value, dut.s_axil_awvalid.value = regs.SCRATCH_OFFSET, 1
    dut.s_axil_wvalid.value = 1
    write = await _clocks_until(dut, [dut.s_axil_awvalid, dut.s_axil_wvalid], dut.s_axil_bvalid)
    # The event sets its status bit at the first edge, and the interrupt follows.
    dut.irq_status_frame_done_set.value = 1
    interrupt = await _clocks_until(dut, [dut.irq_status_frame_done_set], dut.irq) - 1
    assert [read, write, interrupt] == page_figures("landing_regs"), f"clocks {[read, write, interrupt]}; {where()}"


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def ready_does_not_wait_for_valid(dut: HierarchyObject) -> None:
    """All ready outputs are 1 at rest and do not move with the valid of any channel within a clock."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    readies = [getattr(dut, f"s_axil_{channel}ready") for channel in ("aw", "w", "ar")]
    await Timer(1, "ns")
    assert all(int(ready.value) for ready in readies), f"a ready is 0 at rest; {where()}"
    for channel in ("aw", "w", "ar"):
        valid = getattr(dut, f"s_axil_{channel}valid")
        valid.value = 1
        await Timer(1, "ns")
        assert all(int(ready.value) for ready in readies), f"{channel}valid moves a ready within a clock; {where()}"
        valid.value = 0
        await Timer(1, "ns")


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def sticky_status(dut: HierarchyObject) -> None:
    """Each event sets its own bit; 1 clears, 0 keeps; enable gates the interrupt."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    for index, name in enumerate(_status_fields()):
        await bench.write(regs.IRQ_ENABLE_OFFSET, 0)
        await _event(bench, name)
        await bench.settle()
        bench.check_irq()
        assert await bench.read(regs.IRQ_STATUS_OFFSET) == 1 << index, where()
        await bench.write(regs.IRQ_ENABLE_OFFSET, ~(1 << index) & 0x1F)
        await bench.settle()
        bench.check_irq()
        await bench.write(regs.IRQ_ENABLE_OFFSET, 1 << index)
        await bench.settle()
        assert int(dut.irq.value) == 1, f"irq of {name} is 0; {where()}"
        await bench.write(regs.IRQ_STATUS_OFFSET, ~(1 << index) & 0xFFFFFFFF)
        await bench.settle()
        bench.check_irq()
        await bench.write(regs.IRQ_STATUS_OFFSET, 1 << index, strobes=0xE)
        await bench.settle()
        bench.check_irq()
        await bench.write(regs.IRQ_STATUS_OFFSET, 1 << index)
        await bench.settle()
        assert int(dut.irq.value) == 0, f"irq of {name} is 1 after it was cleared; {where()}"


async def _event(bench: Bench, name: str) -> None:
    signal = getattr(bench.dut, f"irq_status_{name}_set")
    signal.value = 1
    await RisingEdge(bench.dut.clk)
    signal.value = 0
    bench.state = golden.set_status(bench.state, 1 << _status_fields().index(name))
    await RisingEdge(bench.dut.clk)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
@cocotb.parametrize(clocks=list(range(8)))
async def event_while_clearing(dut: HierarchyObject, clocks: int) -> None:
    """An event `clocks` after the start of a clear: in the very clock of the clear it stays set."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    await _event(bench, "frame_done")
    clear = cocotb.start_soon(bench.send_write(regs.IRQ_STATUS_OFFSET, 1))
    for _ in range(clocks):
        await RisingEdge(dut.clk)
    dut.irq_status_frame_done_set.value = 1
    await RisingEdge(dut.clk)
    dut.irq_status_frame_done_set.value = 0
    # The clear acts at the clock edge that raises bvalid; the event acted at the edge just passed.
    await Timer(1, "ns")
    cleared_later = not int(dut.s_axil_bvalid.value) and not bench.master.write_if.b_channel.count()
    await clear
    await bench.take_write()
    bench.state = {**bench.state, regs.IRQ_STATUS_OFFSET: 0 if cleared_later else 1}
    await bench.read(regs.IRQ_STATUS_OFFSET)


@cocotb.test(timeout_time=LIMIT_US, timeout_unit="us")
async def time_is_read_in_one_piece(dut: HierarchyObject) -> None:
    """TIME_HI keeps the value of the moment at which TIME_LO was read, while the time runs on across a carry."""
    bench = Bench(dut, Random(getrandbits(32)))
    await bench.reset()
    time = 0x0000_0007_FFFF_FFF0

    async def run() -> None:
        nonlocal time
        while True:
            dut.time_lo_us.value, dut.time_hi_us.value = time & 0xFFFFFFFF, time >> 32
            await RisingEdge(dut.clk)
            time += 1

    cocotb.start_soon(run())
    last = 0
    for _ in range(30):
        low, _ = await _plain_read(bench, regs.TIME_LO_OFFSET)
        for _ in range(bench.rng.randint(0, 9)):
            await RisingEdge(dut.clk)
        high, _ = await _plain_read(bench, regs.TIME_HI_OFFSET)
        now = high << 32 | low
        assert last < now <= time, f"time went from {last:#x} to {now:#x} (now {time:#x}); {where()}"
        last = now


async def _plain_read(bench: Bench, address: int) -> tuple[int, int]:
    channel = bench.master.read_if
    await channel.ar_channel.send(channel.ar_channel._transaction_obj(araddr=address, arprot=0))
    item = await channel.r_channel.recv()
    return int(item.rdata), int(item.rresp)
