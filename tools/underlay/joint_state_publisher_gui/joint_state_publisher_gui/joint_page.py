# SPDX-License-Identifier: Apache-2.0
"""The page with the sliders of a robot, and the folder of saved poses on it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.board import Board
from joint_state_publisher_gui.notice import Notice
from joint_state_publisher_gui.poses import pose_file, PoseError, Poses
from joint_state_publisher_gui.slider_rows import SliderRows
from rviz_common.inputs import on_choice, Post, WorkQueue

if TYPE_CHECKING:
    from viser import GuiApi, GuiFolderHandle, ViserServer

__all__ = ['JointPage', 'PoseFolder']

WIDTH_PX = 460
WARNED_FRAMES = 100

NONE = '(none saved)'


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
                self.poses = PoseFolder(gui, post, board, poses, self.notice)
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


class PoseFolder:
    """
    The widgets to save, load and delete poses.

    Parameters
    ----------
    gui
        Where the folder is added, at the current position.
    post
        Runs the callbacks of widgets in the thread of the node.
    board
        The sliders from which a pose is saved and to which it is applied.
    poses
        The file of the poses.
    notice
        The notice that shows results and errors.

    """

    def __init__(
        self, gui: GuiApi, post: Post, board: Board, poses: Poses, notice: Notice
    ) -> None:
        self._board = board
        self._poses = poses
        self._notice = notice
        with gui.add_folder('Poses'):
            self.saved: Any = gui.add_dropdown('Saved', (NONE,), hint=f'Kept in {poses.file}')
            self.use = gui.add_button_group(' ', ('Load', 'Delete'))
            self.name = gui.add_text('New name', '')
            self.keep = gui.add_button_group(' ', ('Save',))
        on_choice(post, self.use, self._press)
        on_choice(post, self.keep, self._press)
        self._try(self._list)

    def _press(self, label: str) -> None:
        work = {'Load': self._load, 'Delete': self._delete, 'Save': self._save}
        self._try(work.get(label, self._list))

    def _try(self, do: Callable[[], None]) -> None:
        """Run a file operation, and show an error message if it fails."""
        try:
            do()
        except PoseError as error:
            self._notice.say(str(error))

    def _list(self) -> None:
        """Update the list of saved poses from the file."""
        names = tuple(self._poses.read()) or (NONE,)
        if self.saved.options != names:
            self.saved.options = names

    def _load(self) -> None:
        name = self.saved.value
        pose = self._poses.read().get(name)
        self._list()
        if pose is None:
            self._say_missing(name)
            return
        self._notice.say(f"The pose '{name}' is loaded.", *self._board.apply(pose))

    def _save(self) -> None:
        name = self._poses.save(self.name.value, self._board.pose())
        self._list()
        self.saved.value = name
        self._notice.say(f"The pose '{name}' is saved in {self._poses.file}.")

    def _delete(self) -> None:
        name = self.saved.value
        if self._poses.delete(name):
            self._notice.say(f"The pose '{name}' is deleted.")
        else:
            self._say_missing(name)
        self._list()

    def _say_missing(self, name: str) -> None:
        self._notice.say(f"There is no pose '{name}' in {self._poses.file}.")
