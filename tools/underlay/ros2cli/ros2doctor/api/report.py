# SPDX-License-Identifier: Apache-2.0
"""A section of a report."""

from __future__ import annotations


class Report:
    """A title with named items."""

    def __init__(self, name: str) -> None:
        """Begin an empty section."""
        self.name = name
        self.items: list[tuple[str, str]] = []

    def add_to_report(self, item_name: str, item_info: object) -> None:
        """Add a line."""
        self.items.append((item_name, str(item_info)))
