# SPDX-License-Identifier: Apache-2.0
"""The page with the sliders of a robot: its buttons, search, rows and messages."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from pathlib import Path
from random import Random
from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.board import Board, JointSlider
from joint_state_publisher_gui.limbs import Limb
from joint_state_publisher_gui.poses import pose_file, PoseFolder, Poses
from rviz_common.inputs import on_choice, on_input, Post, WorkQueue

if TYPE_CHECKING:
    from viser import GuiApi, GuiFolderHandle, ViserServer

__all__ = ['JointPage', 'Notice', 'SliderRow', 'SliderRows']

WIDTH_PX = 460
WARNED_FRAMES = 100


class JointPage:
    """
    The widgets of the page; all work is done in the thread of the node.

    All changes of one frame are sent to the browsers together.

    Parameters
    ----------
    server
        The viser server of the page.
    queue
        Transfers the callbacks of widgets to the thread of the node.
    poses_folder
        The folder of the saved poses.

    Attributes
    ----------
    poses, sliders
        The saved poses and the sliders; None while no robot is shown.
    notice, warnings
        The status line, and the warnings below it.

    """

    def __init__(self, server: ViserServer, queue: WorkQueue, poses_folder: Path) -> None:
        self._server = server
        self._queue = queue
        self._poses_folder = poses_folder
        self._random = Random()
        self._folder: GuiFolderHandle | None = None
        self.poses: PoseFolder | None = None
        self.sliders: SliderRows | None = None
        server.gui.main_panel.set_width(WIDTH_PX)
        self.notice = Notice(server.gui)
        self.notice.say('Waiting for robot_description ...')
        self.warnings = Notice(server.gui)
        self._warned_frames = 0

    def show(self, board: Board) -> None:
        """
        Show the sliders of a robot, replacing those of the previous one.

        Parameters
        ----------
        board
            The sliders.

        """
        gui = self._server.gui
        with self._server.atomic():
            if self._folder is not None:
                self._folder.remove()
            self.warnings.say()
            self.notice.say(f'{board.robot}: {len(board.sliders)} joints')
            self._folder = gui.add_folder(None)
            with self._folder:
                post = self._post_while(self._folder)
                self._add_buttons(post, board)
                poses = Poses(pose_file(board.robot, self._poses_folder))
                self.poses = PoseFolder(gui, post, board, poses, self.notice.say)
            self.sliders = SliderRows(self._server, post, self._folder, board)

    def warn(self, *sentences: str) -> None:
        """
        Show warnings for the next 100 refreshes, since their cause may be gone afterwards.

        Parameters
        ----------
        *sentences
            The warnings, which replace earlier ones.

        """
        self.warnings.say(*sentences)
        self._warned_frames = WARNED_FRAMES

    def refresh(self) -> None:
        """Update the widgets that have changed."""
        if self.sliders is None:
            return
        with self._server.atomic():
            self.sliders.refresh()
            self._warned_frames -= 1
            if self._warned_frames == 0:
                self.warnings.say()

    def _post_while(self, folder: GuiFolderHandle) -> Post:
        """Return a function that posts work, which runs only while the folder is shown."""

        def do(work: Callable[[], None]) -> None:
            if self._folder is folder:
                work()

        return lambda work: self._queue.post(lambda: do(work))

    def _add_buttons(self, post: Post, board: Board) -> None:
        work: dict[str, Callable[[], None]] = {
            'Centre': board.centre,
            'Zero': board.zero,
            'Randomise': lambda: board.randomise(self._random),
        }
        self.all = self._server.gui.add_button_group(
            'All joints',
            tuple(work),
            hint=(
                "Centre: the default positions, as in the parameter 'zeros'. Zero: 0 or the "
                'nearest limit. Randomise: anywhere within the limits.'
            ),
        )
        on_choice(post, self.all, lambda label: work[label]() if label in work else None)


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


MOST_LINES = 6
LONGEST_LINE = 400
STYLE = 'padding:0.1em 0.8em 0.6em; font-size:0.85em; line-height:1.35; overflow-wrap:anywhere'


class Notice:
    """
    A text area on the page for messages, which may contain arbitrary names.

    Parameters
    ----------
    gui
        Where the widget is added, at the current position; the message is empty at first.

    """

    def __init__(self, gui: GuiApi) -> None:
        self._html = gui.add_html('')

    @property
    def content(self) -> str:
        """Return the messages as HTML."""
        return str(self._html.content)

    def say(self, *sentences: str) -> None:
        """
        Show messages in place of earlier ones, escaped for HTML.

        Parameters
        ----------
        *sentences
            The messages, one per line; at most 6 are shown, each truncated to 400 characters.
            Without messages, the area is cleared.

        """
        lines = [line[:LONGEST_LINE] for line in sentences]
        if len(lines) > MOST_LINES:
            lines[MOST_LINES:] = [f'And {len(lines) - MOST_LINES} more like this.']
        text = '<br>'.join(map(escape, lines))
        content = f'<div style="{STYLE}">{text}</div>' if lines else ''
        if self._html.content != content:
            self._html.content = content
