# SPDX-License-Identifier: Apache-2.0
"""The parts of a page that a command writes: what stands between `<!-- name -->` and `<!-- /name -->`."""

import re

from scripts.errors import UserError


def find_block(text: str, name: str, page: str) -> re.Match[str]:
    """The place of a block.

    Args:
        text: The page.
        name: Of the block.
        page: What the page is called.

    Raises:
        UserError: the page has no such markers.
    """
    found = re.search(rf"(?<=<!-- {name} -->\n).*?(?=<!-- /{name} -->)", text, flags=re.DOTALL)
    if found is None:
        raise UserError(f"{page} has no lines <!-- {name} --> and <!-- /{name} -->; put them in.")
    return found


def with_block(text: str, name: str, content: str, page: str) -> str:
    """The page with another content of a block; arguments and errors are those of `find_block`."""
    place = find_block(text, name, page)
    return f"{text[: place.start()]}{content}\n{text[place.end() :]}"
