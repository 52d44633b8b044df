# SPDX-License-Identifier: Apache-2.0
"""A section of a report."""

from __future__ import annotations


class Report:
    """
    A section of the report: a title with named items.

    Parameters
    ----------
    name
        The title.

    Attributes
    ----------
    items
        The lines in their order, each a name and a text.

    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.items: list[tuple[str, str]] = []

    def add_to_report(self, item_name: str, item_info: object) -> None:
        """
        Add a line to the section.

        Parameters
        ----------
        item_name
            The left column; several lines may have the same name.
        item_info
            The right column, converted by `str`.

        """
        self.items.append((item_name, str(item_info)))
