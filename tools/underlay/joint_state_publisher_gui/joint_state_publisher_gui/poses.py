# SPDX-License-Identifier: Apache-2.0
"""Saved poses of a robot: their file, what can be done with them, and their widgets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import os
from pathlib import Path
import tempfile
from typing import Any, TYPE_CHECKING
from urllib.parse import quote

from joint_state_publisher_gui.board import Board
from rviz_common.inputs import on_choice, Post
import yaml

if TYPE_CHECKING:
    from viser import GuiApi

__all__ = ['BoardPoses', 'Pose', 'PoseError', 'PoseFolder', 'Poses', 'pose_file', 'poses_folder']

Pose = Mapping[str, float]
"""Positions in rad or m by joint name."""
LONGEST_NAME = 60
LARGEST_FILE = 4_000_000
LARGEST = 1e12
NONE = '(none saved)'


class PoseError(ValueError):
    """Raised if poses cannot be read or saved."""


def poses_folder() -> Path:
    """Return the folder of the pose files of all robots."""
    home = os.path.expanduser(os.environ.get('ROS_HOME') or '~/.ros')
    return Path(home) / 'joint_state_publisher_gui'


def pose_file(robot: str, folder: Path) -> Path:
    """
    Build the path of the pose file of a robot.

    Parameters
    ----------
    robot
        The name of the robot; any characters are allowed.
    folder
        The folder of the pose files of all robots.

    """
    return folder / f'{quote(robot, safe=" ()")}.yaml'


class Poses:
    """
    Named poses in a file, which is read on every access because others may write it too.

    Parameters
    ----------
    file
        The YAML file, which need not exist.

    """

    def __init__(self, file: Path) -> None:
        self.file = file

    def read(self) -> dict[str, Pose]:
        """Read the poses, or raise PoseError; empty if the file does not exist."""
        try:
            if self.file.stat().st_size > LARGEST_FILE:
                raise self._broken(f'it is larger than {LARGEST_FILE // 1_000_000} MB')
            content = yaml.safe_load(self.file.read_text(encoding='utf-8'))
        except FileNotFoundError:
            return {}
        except OSError as error:
            raise self._broken(error.strerror or str(error)) from error
        except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as error:
            raise self._broken(' '.join(str(error).split())) from error
        return self._poses({} if content is None else content)

    def save(self, name: str, pose: Pose) -> str:
        """
        Save a pose, replacing one of the same name.

        Parameters
        ----------
        name
            Its name; spaces around it are removed.
        pose
            Positions by joint name, in rad or m.

        Returns
        -------
        str
            The name without spaces around it.

        Raises
        ------
        PoseError
            The name is empty, too long or not printable, or the file cannot be read or written.

        """
        name = name.strip()
        if not name:
            raise PoseError('The pose is not saved: give it a name first.')
        if len(name) > LONGEST_NAME or not name.isprintable():
            raise PoseError(
                f'The pose is not saved: its name must have at most {LONGEST_NAME} characters, '
                'all of them printable.'
            )
        self._write({**self.read(), name: dict(pose)})
        return name

    def delete(self, name: str) -> bool:
        """
        Delete a pose.

        Parameters
        ----------
        name
            Its name.

        Returns
        -------
        bool
            Whether the pose existed.

        Raises
        ------
        PoseError
            The file cannot be read or written.

        """
        poses = self.read()
        if name not in poses:
            return False
        del poses[name]
        self._write(poses)
        return True

    def _poses(self, content: Any) -> dict[str, Pose]:
        if not isinstance(content, dict):
            raise self._broken('it must map names to poses')
        return {str(name): self._pose(name, pose) for name, pose in content.items()}

    def _pose(self, name: Any, pose: Any) -> Pose:
        if not isinstance(pose, dict):
            raise self._broken(f"the pose '{name}' must map joints to positions")
        for joint, value in pose.items():
            if not _is_position(value):
                raise self._broken(
                    f"'{value}' of '{joint}' in the pose '{name}' is not a position"
                )
        return {str(joint): float(value) for joint, value in pose.items()}

    def _broken(self, why: str) -> PoseError:
        return PoseError(
            f"The pose file '{self.file}' cannot be used, and is left unchanged: {why}. "
            'Correct it, or move it away.'
        )

    def _write(self, poses: Mapping[str, Pose]) -> None:
        """Replace the file atomically, so that no reader sees a partial file."""
        text = yaml.safe_dump(
            {name: dict(pose) for name, pose in poses.items()},
            sort_keys=False,
            allow_unicode=True,
        )
        new: Path | None = None
        try:
            self.file.parent.mkdir(parents=True, exist_ok=True)
            descriptor, path = tempfile.mkstemp(suffix='.new', dir=self.file.parent)
            new = Path(path)
            with os.fdopen(descriptor, 'w', encoding='utf-8') as stream:
                stream.write(text)
                stream.flush()
                os.fsync(descriptor)
            new.replace(self.file)
        except OSError as error:
            if new is not None:
                new.unlink(missing_ok=True)
            raise PoseError(
                f"The poses are not saved, as '{self.file}' cannot be written: {error.strerror}."
            ) from error


class BoardPoses:
    """
    Saves the positions of sliders as poses, and moves the sliders to poses.

    Each operation returns sentences for the user, and raises PoseError if the file cannot be used.

    Parameters
    ----------
    board
        The sliders.
    poses
        The file of the poses.

    """

    def __init__(self, board: Board, poses: Poses) -> None:
        self._board = board
        self._poses = poses

    def names(self) -> list[str]:
        """Return the names of the saved poses."""
        return list(self._poses.read())

    def load(self, name: str) -> list[str]:
        """
        Move the sliders to a pose, as far as the robot has its joints.

        Parameters
        ----------
        name
            The name of the pose.

        """
        pose = self._poses.read().get(name)
        if pose is None:
            return [self._missing(name)]
        return [f"The pose '{name}' is loaded.", *self._board.apply(pose)]

    def save(self, name: str) -> list[str]:
        """
        Save where the sliders are.

        Parameters
        ----------
        name
            The name of the pose, as typed.

        """
        saved = self._poses.save(name, self._board.pose())
        return [f"The pose '{saved}' is saved in {self._poses.file}."]

    def delete(self, name: str) -> list[str]:
        """
        Delete a pose.

        Parameters
        ----------
        name
            The name of the pose.

        """
        if self._poses.delete(name):
            return [f"The pose '{name}' is deleted."]
        return [self._missing(name)]

    def _missing(self, name: str) -> str:
        return f"There is no pose '{name}' in {self._poses.file}."


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
    say
        Shows results and errors: texts, one per line.

    """

    def __init__(
        self, gui: GuiApi, post: Post, board: Board, poses: Poses, say: Callable[..., None]
    ) -> None:
        self._poses = BoardPoses(board, poses)
        self._say = say
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
            self._say(str(error))

    def _list(self) -> None:
        """Update the list of saved poses from the file."""
        names = tuple(self._poses.names()) or (NONE,)
        if self.saved.options != names:
            self.saved.options = names

    def _load(self) -> None:
        sentences = self._poses.load(self.saved.value)
        self._list()
        self._say(*sentences)

    def _save(self) -> None:
        sentences = self._poses.save(self.name.value)
        self._list()
        self.saved.value = self.name.value.strip()
        self._say(*sentences)

    def _delete(self) -> None:
        self._say(*self._poses.delete(self.saved.value))
        self._list()


def _is_position(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return -LARGEST <= value <= LARGEST
