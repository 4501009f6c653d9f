# SPDX-License-Identifier: Apache-2.0
# Pins of the Arty Z7-20 that the stand-in knows, from Digilent's master constraints: pin, name in the schematic.
# Entered apart from constraints/arty_z7.xdc, so that a slip in one of the two shows.

namespace eval standin {
    variable pins
    variable taken
    array set taken {}
    array set pins {
        H16 SYSCLK M20 SW0 M19 SW1 R14 LED0 P14 LED1 N16 LED2 M14 LED3 D19 BTN0 D20 BTN1 L20 BTN2 L19 BTN3
        Y18 JA1 Y19 JA2 Y16 JA3 Y17 JA4 U18 JA7 U19 JA8 W18 JA9 W19 JA10
        W14 JB1 Y14 JB2 T11 JB3 T10 JB4 V16 JB7 W16 JB8 V12 JB9 W13 JB10
        P19 HDMI_RX_CLK_N N18 HDMI_RX_CLK_P W20 HDMI_RX_D0_N V20 HDMI_RX_D0_P U20 HDMI_RX_D1_N T20 HDMI_RX_D1_P
        P20 HDMI_RX_D2_N N20 HDMI_RX_D2_P T19 HDMI_RX_HPD U14 HDMI_RX_SCL U15 HDMI_RX_SDA H17 HDMI_RX_CEC
        L17 HDMI_TX_CLK_N L16 HDMI_TX_CLK_P K18 HDMI_TX_D0_N K17 HDMI_TX_D0_P J19 HDMI_TX_D1_N K19 HDMI_TX_D1_P
        H18 HDMI_TX_D2_N J18 HDMI_TX_D2_P R19 HDMI_TX_HPDN M17 HDMI_TX_SCL M18 HDMI_TX_SDA G15 HDMI_TX_CEC
        T14 CK_IO0 U12 CK_IO1 U13 CK_IO2 V13 CK_IO3 V15 CK_IO4 T15 CK_IO5 R16 CK_IO6 U17 CK_IO7 V17 CK_IO8
        V18 CK_IO9 T16 CK_IO10 R17 CK_IO11 P18 CK_IO12 N17 CK_IO13
    }
}

# A pin exists, and has one port; two standards do not meet on one pin.
proc standin::check_port {object name value} {
    variable pins
    variable taken
    if {$name ne "PACKAGE_PIN"} {
        return
    }
    if {![info exists pins($value)]} {
        fail "the board has no pin $value for [name_of $object]"
    }
    if {[info exists taken($value)] && $taken($value) ne $object} {
        fail "pin $value is given to [name_of $taken($value)] and to [name_of $object]"
    }
    set taken($value) $object
    puts "pin [name_of $object] $value $pins($value)"
}

# Every port but those of the processor has a pin and a standard.
proc standin::check_ports {} {
    variable known
    foreach object [lsort [array names known port|*]] {
        set name [name_of $object]
        if {[string match DDR_* $name] || [string match FIXED_IO_* $name]} {
            continue
        }
        foreach property {PACKAGE_PIN IOSTANDARD} {
            if {![dict exists $known($object) $property]} {
                fail "port $name has no $property"
            }
        }
    }
}
