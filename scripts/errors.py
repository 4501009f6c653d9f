# SPDX-License-Identifier: Apache-2.0
"""The one way in which every tool of the project reports what a user can mend."""

import sys
from collections.abc import Callable


class UserError(Exception):
    """Something the user can mend; the message is one sentence that says how."""


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
