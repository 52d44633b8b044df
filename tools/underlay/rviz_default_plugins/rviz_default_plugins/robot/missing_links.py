# SPDX-License-Identifier: Apache-2.0
"""Reports on the links of a robot that no transform places, with a remedy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rviz_common.status import Level, Statuses
from urdf import Joint, RobotModel

__all__ = ['say_missing']

MAX_SENTENCES = 20
SUBJECT = 'Link '


def say_missing(
    status: Statuses,
    unknown: Sequence[Joint],
    model: RobotModel,
    frames: Iterable[str],
    prefix: str,
) -> None:
    """
    Report the links of a robot without a transform in the status, replacing earlier reports.

    Parameters
    ----------
    status
        The status of the display.
    unknown
        The joints whose pose is unknown.
    model
        The robot.
    frames
        The names of the known frames, used to detect a wrong prefix.
    prefix
        The prefix of the links in the names of frames, with a trailing slash, or ''.

    """
    for subject, _, _ in status.items():
        if subject.startswith(SUBJECT):
            status.forget(subject)
    for link, sentence in _sentences(unknown, model, frames, prefix):
        status.say(SUBJECT + link, Level.ERROR, sentence)


def _sentences(
    unknown: Sequence[Joint], model: RobotModel, frames: Iterable[str], prefix: str
) -> Iterator[tuple[str, str]]:
    if unknown and len(unknown) == len(model.joints):
        yield '...', _nobody(unknown[0], frames, prefix)
        return
    for joint in unknown[:MAX_SENTENCES]:
        yield joint.child, f'{_no_transform(joint, prefix)}: {_reason(joint)}'
    if len(unknown) > MAX_SENTENCES:
        yield '...', f'{len(unknown) - MAX_SENTENCES} more links have no transform.'


def _no_transform(joint: Joint, prefix: str) -> str:
    return f'No transform from [{prefix}{joint.child}] to [{prefix}{joint.parent}]'


def _reason(joint: Joint) -> str:
    if not joint.moves:
        return f"robot_state_publisher publishes that of joint '{joint.name}'. Is it running?"
    master = joint.mimic.joint if joint.mimic else joint.name
    return (
        f"robot_state_publisher has received no joint state for '{master}' yet. Start the node "
        'that publishes joint_states.'
    )


def _nobody(joint: Joint, frames: Iterable[str], prefix: str) -> str:
    """Suggest a remedy if there is no transform at all: a publisher, or another prefix."""
    what = f'{_no_transform(joint, prefix)}, nor of any other link: no node publishes them.'
    for name in sorted(frames):
        if name.endswith(f'/{joint.child}') and name != prefix + joint.child:
            meant = name[: -len(joint.child) - 1]
            return f"{what} There is [{name}], though: set 'TF Prefix' to '{meant}'."
    return f'{what} Start robot_state_publisher, and a publisher of joint_states.'
