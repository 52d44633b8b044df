# SPDX-License-Identifier: Apache-2.0
"""One row of the static tables of commands and verbs."""

from __future__ import annotations

from importlib import import_module
from typing import Any, NamedTuple


class Entry(NamedTuple):
    """Where the class of a command or verb is defined, and what it does, without importing it."""

    target: str
    summary: str
    hidden: bool = False

    def create(self) -> Any:
        """Import the class which `module:Class` names and return an instance of it."""
        module, _, name = self.target.partition(':')
        return getattr(import_module(module), name)()
