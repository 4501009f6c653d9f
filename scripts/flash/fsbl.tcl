# SPDX-License-Identifier: Apache-2.0
# The first stage boot loader, made by Vitis from the hardware: xsct scripts/flash/fsbl.tcl <xsa> <folder>

lassign $argv xsa folder
platform create -name touchdown -hw $xsa -proc ps7_cortexa9_0 -os standalone -out $folder
platform generate
