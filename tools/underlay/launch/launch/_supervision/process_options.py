# SPDX-License-Identifier: Apache-2.0
"""How a process is to be run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, TYPE_CHECKING

from launch._checked import text_like
from launch.substitution import Substitution
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions
from launch.utilities.type_utils import perform_typed_substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@dataclass(frozen=True)
class ProcessOptions:
    """The options of a process; those that are not plain are performed when needed."""

    shell: bool
    emulate_tty: bool
    cached_output: bool
    log_cmd: bool
    output: Any
    output_format: str
    sigterm_timeout: list[Substitution]
    sigkill_timeout: list[Substitution]
    respawn: Any
    respawn_delay: Optional[float]
    respawn_max_retries: int

    def may_respawn(self, context: LaunchContext, respawned: int) -> bool:
        """Return whether the process is to be started again after so many times."""
        if not perform_typed_substitution(context, self.respawn, bool):
            return False
        return self.respawn_max_retries < 0 or respawned < self.respawn_max_retries

    def wants_tty(self, context: LaunchContext) -> bool:
        """Return whether the output is a terminal for the process."""
        override = context.launch_configurations.get('emulate_tty')
        if override is None:
            return self.emulate_tty
        from launch.conditions.evaluate_condition_expression_impl import (
            evaluate_condition_expression,
        )

        return evaluate_condition_expression(
            context, normalize_to_list_of_substitutions(str(override))
        )

    def where_output_goes(self, context: LaunchContext) -> Any:
        """Return the performed `output`."""
        if not isinstance(self.output, list):
            return self.output
        return perform_substitutions(context, self.output)


def timeout_substitutions(keyword: str, value: Any) -> list[Substitution]:
    """Return a timeout, which may be a plain number, as substitutions."""
    return text_like(keyword, str(value) if isinstance(value, (int, float)) else value)


def output_substitutions(value: Any) -> Any:
    """Return an `output`, which may be a dictionary, as substitutions if it is a text."""
    return value if isinstance(value, dict) else text_like('output', value)
