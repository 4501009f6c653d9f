# SPDX-License-Identifier: Apache-2.0
"""The table as C: enumerations and masks in the header, the constant tables in the source."""

from scripts.landing.model import MODES, SOURCE, STEERS, Landing

LICENSE = "// SPDX-License-Identifier: Apache-2.0"
GENERATED = f"// Generated from {SOURCE} by python -m scripts.landing. Do not edit."


def header(landing: Landing) -> str:
    """Text of firmware/generated/landing_table.h."""
    lines = [
        LICENSE,
        GENERATED,
        "#ifndef LANDING_TABLE_H",
        "#define LANDING_TABLE_H",
        "",
        "#include <stdint.h>",
        "",
        _enumeration("landing_phase", "LANDING_PHASE", [phase.name for phase in landing.phases], "LANDING_PHASES"),
        "",
        _enumeration("landing_mode", "LANDING_MODE", [mode.upper() for mode in MODES], "LANDING_MODES"),
        "",
        _enumeration("landing_steer", "LANDING_STEER", [steer.upper() for steer in STEERS], "LANDING_STEERS"),
        "",
        "// What is known in a cycle.",
        *(
            f"#define LANDING_FACT_{fact.name} 0x{1 << bit:08x}u // {fact.says}"
            for bit, fact in enumerate(landing.facts)
        ),
        "",
        "struct landing_phase_row {",
        "    const char *name;",
        "    enum landing_mode mode;   // what the autopilot is to be in",
        "    enum landing_steer steer; // how velocities are made",
        "    uint32_t limit_s;         // 0 = none",
        "};",
        "",
        "struct landing_rule {",
        "    uint32_t from;   // a bit a phase",
        "    uint32_t when;   // facts that have to hold",
        "    uint32_t unless; // facts that must not",
        "    enum landing_phase to;",
        "    uint8_t severity; // MAV_SEVERITY",
        "    const char *reason;",
        "};",
        "",
        f"#define LANDING_RULES {len(landing.rules)}u",
        "",
        "extern const struct landing_phase_row landing_phase_table[LANDING_PHASES];",
        "extern const struct landing_rule landing_rules[LANDING_RULES];",
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def parameters(landing: Landing) -> str:
    """Text of firmware/generated/landing_parameters.h."""
    rows = [
        f'    X({p.member}, "{p.name}", {float(p.least)}F, {float(p.most)}F, {float(p.usual)}F)'
        for p in landing.parameters
    ]
    lines = [
        LICENSE,
        GENERATED,
        "#ifndef LANDING_PARAMETERS_H",
        "#define LANDING_PARAMETERS_H",
        "",
        "// X(member, name on the wire, least, most, usual)",
        "#define LANDING_PARAMETERS(X) \\",
        " \\\n".join(rows),
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def source(landing: Landing) -> str:
    """Text of firmware/generated/landing_table.c."""
    severity = {"INFO": 6, "WARNING": 4, "CRITICAL": 2}
    bits = {phase.name: bit for bit, phase in enumerate(landing.phases)}
    facts = {fact.name: bit for bit, fact in enumerate(landing.facts)}
    lines = [
        LICENSE,
        GENERATED,
        '#include "landing_table.h"',
        "",
        "const struct landing_phase_row landing_phase_table[LANDING_PHASES] = {",
        *(
            f'    {{"{phase.name}", LANDING_MODE_{phase.mode.upper()}, LANDING_STEER_{phase.steer.upper()},'
            f" {phase.limit_s}u}},"
            for phase in landing.phases
        ),
        "};",
        "",
        "const struct landing_rule landing_rules[LANDING_RULES] = {",
        *(
            f"    {{{_mask(rule.sources, bits)}, {_mask(rule.when, facts)}, {_mask(rule.unless, facts)},"
            f' LANDING_PHASE_{rule.to}, {severity[rule.severity]}u, "{rule.reason}"}},'
            for rule in landing.rules
        ),
        "};",
    ]
    return "\n".join(lines) + "\n"


def _mask(names: tuple[str, ...], bits: dict[str, int]) -> str:
    return f"0x{sum(1 << bits[name] for name in set(names)):08x}u"


def _enumeration(name: str, prefix: str, members: list[str], count: str) -> str:
    return "\n".join([f"enum {name} {{", *(f"    {prefix}_{member}," for member in members), f"    {count}", "};"])
