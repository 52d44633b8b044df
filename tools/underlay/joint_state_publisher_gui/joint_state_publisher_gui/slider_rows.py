# SPDX-License-Identifier: Apache-2.0
"""The joint sliders on the page."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.board import Board
from joint_state_publisher_gui.joint_slider import JointSlider
from joint_state_publisher_gui.limbs import Limb
from joint_state_publisher_gui.notice import Notice
from rviz_common.inputs import on_input, Post

if TYPE_CHECKING:
    from viser import GuiApi, GuiFolderHandle, ViserServer

__all__ = ['SliderRow', 'SliderRows']

MOST_ROWS = 200
OPEN_ROWS = 12
"""Groups are expanded initially as long as they have at most this many joints in total."""

FIGURE_SPACE = '\u2007'
MINUS = '\u2212'  # viser may break lines after the ASCII hyphen
LENGTH = len('-180°')
SETTLED = 5
"""Number of frames without input after which the page is synchronised."""


class SliderRows:
    """
    Groups of sliders, and a search field for joints.

    Parameters
    ----------
    server
        The viser server of the page.
    post
        Runs the callbacks of widgets in the thread of the node.
    parent
        The folder in which the search field and the sliders are added.
    board
        The sliders of the robot.

    """

    def __init__(
        self, server: ViserServer, post: Post, parent: GuiFolderHandle, board: Board
    ) -> None:
        self._server = server
        self._post = post
        self._parent = parent
        self._board = board
        with parent:
            self.search = server.gui.add_text('Search', '', hint='Words from joint names')
            self._area = server.gui.add_folder(None)
        on_input(post, self.search, self._search)
        self.rows: list[SliderRow] = []
        """The current rows."""
        self._search('')

    def refresh(self) -> None:
        """Update the sliders whose joints were moved by other sources than the user."""
        for row in self.rows:
            row.refresh()

    def _search(self, text: str) -> None:
        """Show only the joints that match; all for an empty text."""
        found = self._board.found(text)
        with self._server.atomic():
            self._area.remove()
            with self._parent:
                self._area = self._server.gui.add_folder(None)
            self.rows = []
            with self._area:
                for limb in found:
                    self._add(limb)
                self._say_what_is_missing(sum(len(limb.joints) for limb in found))

    def _say_what_is_missing(self, count: int) -> None:
        """Show a message if there are no sliders, or fewer than joints found."""
        notice = Notice(self._server.gui)
        if not self._board.sliders:
            notice.say('This robot has no movable joints.')
        elif not count:
            notice.say('No joint name matches.')
        elif count > len(self.rows):
            notice.say(f'{len(self.rows)} of {count} joints are shown. Search for the others.')

    def _add(self, limb: Limb) -> None:
        """Add a group, expanded if it is near the top."""
        names = limb.joints[: MOST_ROWS - len(self.rows)]
        if not names:
            return
        is_open = len(self.rows) + len(limb.joints) <= OPEN_ROWS
        gui = self._server.gui
        with gui.add_folder(f'{limb.title} ({len(limb.joints)})', expand_by_default=is_open):
            for name in names:
                slider = self._board.sliders[name]
                self.rows.append(SliderRow(gui, self._post, slider, limb.label(name)))


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
