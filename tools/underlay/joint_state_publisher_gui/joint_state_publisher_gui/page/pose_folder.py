# SPDX-License-Identifier: Apache-2.0
"""The folder of saved poses on the page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.core.board import Board
from joint_state_publisher_gui.core.poses import PoseError, Poses
from joint_state_publisher_gui.page.notice import Notice
from rviz_common.inputs import on_choice, Post

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['PoseFolder']

NONE = '(none is saved)'


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
