# SPDX-License-Identifier: Apache-2.0
"""Badge that stays visible while recorded data is shown."""

from __future__ import annotations

from html import escape
from typing import Any

from rviz_common.context import Context
from rviz_common.status import Level

__all__ = ['Badge']

SUBJECT = 'Playing'
RECORDED = 'This is recorded, not live.'
MIXED = 'Recorded and live are mixed.'
# Over the scene and below toasts; not among the widgets, which are 24em wide and which users may
# scroll or collapse.
STYLE = (
    'position: fixed; bottom: 1em; left: max(9em, 50vw - 12em); transform: translateX(-50%); '
    'z-index: 1000; width: max-content; max-width: 17em; '
    'padding: 0.45em 1em; border-radius: 4px; pointer-events: none; '
    'color: #fff; font-size: 0.9em; line-height: 1.35; text-align: center; '
    'overflow-wrap: anywhere; background: '
)
COLORS = {RECORDED: '#7048e8', MIXED: '#e8590c'}


class Badge:
    """
    A badge over the scene, and an entry in the status summary, while a recording is played.

    Parameters
    ----------
    context
        The context of the panel.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._said = ('', '')
        self._html: Any = None

    def update(self, name: str, is_mixed: bool = False) -> None:
        """
        Show which recording is played; call it outside any tab.

        Parameters
        ----------
        name
            The name of the recording; '' removes the badge.
        is_mixed
            Whether live nodes publish on the same topics at the same time.

        """
        said = name, MIXED if is_mixed else RECORDED
        if said == self._said:
            return
        self._said = said
        if self._html is not None:
            self._html.remove()
            self._html = None
        if name:
            self._html = self._context.gui.add_html(_html(*said))
        self._say(*said)

    def _say(self, name: str, sentence: str) -> None:
        """Update the entry in the status summary of the page."""
        visualizer = self._context.visualizer
        if visualizer is None:
            return
        if name:
            visualizer.status.say(SUBJECT, Level.WARN, f'{name}. {sentence}')
        else:
            visualizer.status.forget(SUBJECT)


def _html(name: str, sentence: str) -> str:
    style = STYLE + COLORS[sentence]
    return f'<div role="status" style="{style}"><b>PLAYING {escape(name)}</b><br>{sentence}</div>'
