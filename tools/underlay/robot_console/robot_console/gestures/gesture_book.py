# SPDX-License-Identifier: Apache-2.0
"""What a person can choose from: the gestures of a file, and the saved poses of a robot."""

from __future__ import annotations

from collections.abc import Mapping

from joint_state_publisher_gui.poses import pose_file, PoseError, Poses, poses_folder
from robot_console.gestures.gesture_file import Gesture, read_gestures, saved_pose
from rviz_default_plugins.robot.mesh_file import find_file

__all__ = ['POSE', 'GestureBook']

GESTURE, POSE = 'gesture/', 'pose/'
"""What the keys of gestures and of saved poses begin with."""
LARGEST_FILE = 1_000_000
NO_ROBOT = 'The pose is not saved: there is no robot description yet.'


class GestureBook:
    """
    The gestures of a file, and the saved poses of a robot, which its joint sliders share.

    Parameters
    ----------
    file
        The file of the gestures: an absolute path, file:// or package://; '' for none.

    Attributes
    ----------
    gestures
        All of them, by keys that also say which are saved poses.
    problem
        Why the file of the gestures, or that of the poses, cannot be used; '' if they can.

    """

    def __init__(self, file: str) -> None:
        self._of_file: tuple[Gesture, ...] = ()
        self._file_problem = ''
        try:
            self._of_file = _read(file)
        except ValueError as error:
            self._file_problem = str(error)
        self.gestures: dict[str, Gesture] = {}
        self.problem = ''
        self._poses: Poses | None = None
        self.refresh()

    def refresh(self, robot: str = '') -> None:
        """
        Read the saved poses again, since others may save poses, too.

        Parameters
        ----------
        robot
            The name of the robot in its description; '' if it is not known.

        """
        self._poses = Poses(pose_file(robot, poses_folder())) if robot else None
        self.problem = self._file_problem
        saved: Mapping[str, Mapping[str, float]] = {}
        try:
            saved = self._poses.read() if self._poses is not None else {}
        except PoseError as error:
            self.problem = f'{self.problem} {error}'.lstrip()
        self.gestures = {f'{GESTURE}{each.name}': each for each in self._of_file}
        self.gestures |= {f'{POSE}{name}': saved_pose(name, pose) for name, pose in saved.items()}

    def save(self, name: str, pose: Mapping[str, float]) -> None:
        """
        Save a pose, replacing one of the same name.

        Parameters
        ----------
        name
            Its name.
        pose
            Positions by joint, in rad or m.

        Raises
        ------
        ValueError
            The pose cannot be saved; the message is a full sentence.

        """
        if self._poses is None:
            raise ValueError(NO_ROBOT)
        self._poses.save(name, pose)

    def delete(self, key: str) -> None:
        """
        Delete a saved pose.

        Parameters
        ----------
        key
            Its key in `gestures`.

        Raises
        ------
        ValueError
            There is no such pose, or it cannot be deleted; the message is a full sentence.

        """
        is_pose = key.startswith(POSE)
        if self._poses is None or not is_pose or not self._poses.delete(key[len(POSE) :]):
            raise ValueError('This pose no longer exists.')


def _read(file: str) -> tuple[Gesture, ...]:
    """Read the gestures of a file, or raise ValueError with a full sentence."""
    if not file:
        raise ValueError("No gestures: the property 'File' of the panel names no file.")
    path = find_file(file)
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError(f"'{path}' is too large for a file of gestures.")
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise ValueError(f"The gestures '{path}' cannot be read: {error.strerror}.") from None
    except UnicodeDecodeError:
        raise ValueError(f"'{path}' is not a text in UTF-8.") from None
    return read_gestures(text, str(path))
