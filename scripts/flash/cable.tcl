# SPDX-License-Identifier: Apache-2.0
# The USB-JTAG of the Arty Z7-20 for OpenOCD. As interface/ftdi/digilent-hs1.cfg, but whatever name the cable gives:
# that of a board differs from that of Digilent's cables.
adapter driver ftdi
ftdi vid_pid 0x0403 0x6010
ftdi channel 0
ftdi layout_init 0x0088 0x008b
reset_config none
