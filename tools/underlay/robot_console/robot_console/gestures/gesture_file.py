# SPDX-License-Identifier: Apache-2.0
"""The YAML file of gestures: named sequences of joint positions and body poses."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
import math
from typing import Any

from ros_environment.suggestions import did_you_mean
from rviz_common.config.yaml_file import ConfigError, Document, Place, read_yaml

__all__ = ['UPRIGHT', 'BodyPose', 'Gesture', 'GestureError', 'Step', 'read_gestures', 'saved_pose']

OF_FILE = ('optional_joints', 'poses', 'gestures')
OF_GESTURE = ('about', 'steps')
OF_STEP = ('seconds', 'poses', 'joints', 'body')
OF_BODY = ('pitch', 'height')
LONGEST_S = 60.0
MOST_STEPS = 100
SAVED_S = 2.0
"""The duration of the motion to a saved pose."""


class GestureError(ValueError):
    """A gesture that cannot be read, or that a robot cannot carry out; a full sentence."""


@dataclass(frozen=True)
class BodyPose:
    """The pitch of the body, positive forward, and its height relative to an upright robot."""

    pitch_rad: float = 0.0
    height_m: float = 0.0


UPRIGHT = BodyPose()


@dataclass(frozen=True)
class Step:
    """One step of a gesture: where joints are at its end, and which body pose begins with it."""

    duration_s: float
    """The least duration; the step takes longer where a joint would be too fast."""
    joints: Mapping[str, float] = field(default_factory=dict)
    """Positions in rad or m by joint; other joints stay where they are."""
    body: BodyPose | None = None


@dataclass(frozen=True)
class Gesture:
    """A named sequence of steps."""

    name: str
    steps: tuple[Step, ...]
    about: str = ''
    optional_joints: frozenset[str] = frozenset()
    """Joints that are left out if the robot does not have them, or no controller moves them."""

    @property
    def bends(self) -> bool:
        """Whether it commands the body pose."""
        return any(step.body is not None for step in self.steps)


def saved_pose(name: str, joints: Mapping[str, float]) -> Gesture:
    """
    Make the gesture that brings the joints to a saved pose.

    Parameters
    ----------
    name
        The name of the pose.
    joints
        Positions in rad or m by joint; those that no controller moves are left out.

    """
    return Gesture(name, (Step(SAVED_S, dict(joints)),), '', frozenset(joints))


def read_gestures(text: str, source: str) -> tuple[Gesture, ...]:
    """
    Read a file of gestures.

    Parameters
    ----------
    text
        The YAML of the file.
    source
        Its name, for error messages.

    Returns
    -------
    tuple of Gesture
        The gestures, in the order of the file.

    Raises
    ------
    GestureError
        The file is invalid; the message has the line of the first error.

    """
    try:
        document = read_yaml(text, source)
        return _Reader(document).gestures()
    except ConfigError as error:
        raise GestureError(str(error)) from None


class _Reader:
    """Converts a document to gestures, and reports the first value that is wrong."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._optional: frozenset[str] = frozenset()
        self._poses: dict[str, Mapping[str, float]] = {}

    def gestures(self) -> tuple[Gesture, ...]:
        """Return the gestures of the file."""
        content = self._mapping(self._document.values, (), 'The file', OF_FILE)
        self._optional = frozenset(
            self._names(content.get('optional_joints', []), ('optional_joints',))
        )
        poses = self._mapping(content.get('poses', {}), ('poses',), "'poses'")
        self._poses = {
            name: self._joints(pose, ('poses', name), f"The pose '{name}'")
            for name, pose in poses.items()
        }
        found = self._mapping(content.get('gestures', {}), ('gestures',), "'gestures'")
        if not found:
            raise self._error((), "It has no gestures. List them below 'gestures'")
        return tuple(self._gesture(name, content) for name, content in found.items())

    def _gesture(self, name: str, content: Any) -> Gesture:
        place: Place = ('gestures', name)
        what = f"The gesture '{name}'"
        content = self._mapping(content, place, what, OF_GESTURE)
        steps = content.get('steps')
        if not isinstance(steps, list) or not 0 < len(steps) <= MOST_STEPS:
            raise self._error(place, f"{what} needs 'steps', a list of 1 to {MOST_STEPS}")
        return Gesture(
            name,
            tuple(
                self._step(step, (*place, 'steps', index), f'Step {index + 1} of {name!r}')
                for index, step in enumerate(steps)
            ),
            str(content.get('about') or ''),
            self._optional,
        )

    def _step(self, content: Any, place: Place, what: str) -> Step:
        content = self._mapping(content, place, what, OF_STEP)
        seconds = content.get('seconds')
        if not _is_number(seconds) or not 0.0 < seconds <= LONGEST_S:
            raise self._error(
                (*place, 'seconds'), f"{what} needs 'seconds', from 0 to {LONGEST_S:g}"
            )
        joints: dict[str, float] = {}
        for pose in self._names(content.get('poses', []), (*place, 'poses')):
            if pose not in self._poses:
                meant = did_you_mean(pose, self._poses)
                raise self._error(
                    (*place, 'poses'),
                    f"{what} has the pose '{pose}', which is not in 'poses'",
                    meant,
                )
            joints.update(self._poses[pose])
        joints.update(self._joints(content.get('joints', {}), (*place, 'joints'), what))
        return Step(float(seconds), joints, self._body(content, place, what))

    def _body(self, step: Mapping[str, Any], place: Place, what: str) -> BodyPose | None:
        if 'body' not in step:
            return None
        place = (*place, 'body')
        content = self._mapping(
            step['body'], place, f"'body' of {what[0].lower()}{what[1:]}", OF_BODY
        )
        values = self._joints(content, place, what)
        return BodyPose(values.get('pitch', 0.0), values.get('height', 0.0))

    def _joints(self, content: Any, place: Place, what: str) -> dict[str, float]:
        """Return a mapping of names to numbers."""
        content = self._mapping(content, place, what)
        for name, value in content.items():
            if not _is_number(value):
                raise self._error(
                    (*place, name), f"{what}: '{name}' must be a number, not '{value}'"
                )
        return {name: float(value) for name, value in content.items()}

    def _names(self, content: Any, place: Place) -> list[str]:
        if not isinstance(content, list) or not all(isinstance(each, str) for each in content):
            raise self._error(place, f"'{place[-1]}' must be a list of names")
        return content

    def _mapping(
        self, content: Any, place: Place, what: str, known: Collection[str] = ()
    ) -> dict[str, Any]:
        """Check that a value is a mapping with names as keys, of those that are known."""
        if not isinstance(content, dict):
            raise self._error(place, f'{what} must be a mapping, not {content!r:.40}')
        for key in content:
            if not isinstance(key, str):
                raise self._error(place, f"{what}: '{key}' must be a name; put it in quotes")
            if known and key not in known:
                meant = did_you_mean(key, known) or f'Known are: {", ".join(known)}.'
                raise self._error((*place, key), f"{what} has an unknown key '{key}'", meant)
        return content

    def _error(self, place: Place, text: str, more: str = '') -> GestureError:
        return GestureError(f'{self._document.where(place)}: {text}. {more}'.rstrip())


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
