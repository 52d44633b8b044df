# SPDX-License-Identifier: Apache-2.0
"""Event handler for the output by which a process signals that it is ready."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.process_event_handlers import OnProcessIO
from launch.events.process import ProcessIO
from launch.some_entities_type import SomeEntitiesType

if TYPE_CHECKING:
    from launch.actions import ExecuteLocal


class StdoutReadyListener(OnProcessIO):
    """
    Visits actions once, when a process has written a certain text to its standard output.

    Parameters
    ----------
    target_action
        The action of the process; None for any process.
    ready_txt
        The text, which may arrive in several chunks.
    actions
        The entities to visit.

    """

    def __init__(
        self,
        *,
        target_action: Optional[Union[ExecuteLocal, Any]] = None,
        ready_txt: str,
        actions: SomeEntitiesType,
    ) -> None:
        super().__init__(target_action=target_action, on_stdout=self._on_stdout)
        self._ready_text = ready_txt
        self._actions: Optional[SomeEntitiesType] = actions
        self._text: dict[Any, str] = {}

    def _on_stdout(self, event: ProcessIO) -> Optional[SomeEntitiesType]:
        text = self._text.get(event.action, '') + event.text.decode('utf-8', 'replace')
        self._text[event.action] = text
        if self._ready_text not in text:
            return None
        actions, self._actions = self._actions, None
        return actions

    def describe(self) -> tuple[str, list[Any]]:
        """Return a short human-readable description and the actions."""
        actions = self._actions
        listed = [] if actions is None else actions if isinstance(actions, list) else [actions]
        return super().describe()[0], listed
