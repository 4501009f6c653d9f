# SPDX-License-Identifier: Apache-2.0
"""The one way in which every tool of the project reports what a user can mend."""

import argparse
import sys
from collections.abc import Callable
from typing import NoReturn


class UserError(Exception):
    """Something the user can mend; the message is one sentence that says how."""


class ArgumentParser(argparse.ArgumentParser):
    """A parser that reports a wrong option as one sentence, as every other mistake is."""

    def error(self, message: str) -> NoReturn:
        """Raise `UserError` in place of the usage text."""
        raise UserError(f"{message}; `{self.prog} --help` lists the options.")


def run_main(main: Callable[[], int | None]) -> None:
    """Run an entry point and exit; a `UserError` becomes one line on stderr and exit code 1."""
    try:
        sys.exit(main() or 0)
    except UserError as error:
        print(f"touchdown: {error}", file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        print("touchdown: interrupted.", file=sys.stderr)
        sys.exit(130)
