# SPDX-License-Identifier: Apache-2.0
"""The page with the sliders of a robot."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from joint_state_publisher_gui.core.board import Board
from joint_state_publisher_gui.core.poses import pose_file, Poses
from joint_state_publisher_gui.page.notice import Notice
from joint_state_publisher_gui.page.pose_folder import PoseFolder
from joint_state_publisher_gui.page.slider_rows import SliderRows
from rviz_common.inputs import on_choice, Post
from rviz_common.work_queue import WorkQueue

if TYPE_CHECKING:
    from viser import GuiFolderHandle, ViserServer

__all__ = ['JointPage']

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
                "Centre: the positions by default, as the parameter 'zeros' says. Zero: 0 or the "
                'nearest limit. Randomise: anywhere within the limits.'
            ),
        )
        on_choice(post, self.all, lambda label: work[label]() if label in work else None)
