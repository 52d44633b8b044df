# SPDX-License-Identifier: Apache-2.0
"""A joint slider on the page."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.core.joint_slider import JointSlider
from rviz_common.inputs import on_input, Post

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['SliderRow']

FIGURE_SPACE = '\u2007'
MINUS = '\u2212'  # viser may break lines after the ASCII hyphen
LENGTH = len('-180°')
SETTLED = 5
"""Number of frames without input after which the page is synchronised."""


class SliderRow:
    """
    The slider of a joint with its value, its limits and, in the label, the value in another unit.

    Parameters
    ----------
    gui
        Where the slider is added, at the current position.
    post
        Runs the callbacks of the slider in the thread of the node.
    slider
        The joint that it displays and moves.
    label
        The displayed name of the joint.

    Attributes
    ----------
    handle
        The handle of the slider in viser.

    """

    def __init__(self, gui: GuiApi, post: Post, slider: JointSlider, label: str) -> None:
        self.slider = slider
        self._label = label
        self._quiet = 0
        scale = slider.scale
        first, last = scale.ends
        self.handle: Any = gui.add_slider(
            self._text(),
            min=first,
            max=last,
            step=scale.step,
            initial_value=slider.shown,
            marks=((first, f'{first:g}'), (last, f'{last:g}')),
            disabled=first >= last,
            hint=f'{slider.name}: {scale.describe()}',
        )
        on_input(post, self.handle, self._take)

    def refresh(self) -> None:
        """Update the slider to the position of the joint."""
        news = self.slider.news()
        self._quiet += 1
        if news is not None or self._quiet == SETTLED:
            self.handle.value = self.slider.shown
        text = self._text()
        if self.handle.label != text:
            self.handle.label = text

    def _take(self, shown: float) -> None:
        self._quiet = 0
        self.slider.give(shown)

    def _text(self) -> str:
        """Return a label of constant length, so that lines do not rewrap while the joint moves."""
        words = self.slider.scale.in_words(self.slider.position)
        return f'{self._label} {words.replace("-", MINUS).ljust(LENGTH, FIGURE_SPACE)}'
