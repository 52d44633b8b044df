# SPDX-License-Identifier: Apache-2.0
"""Checks of robot models."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_description.checks.build import NAME
from humanoid_description.checks.humanoid import NAMES, SHAPE
from humanoid_description.checks.joints import JOINTS, STRUCTURE
from humanoid_description.checks.links import BODIES, MESHES
from humanoid_description.checks.outcome import Check, Outcome
from humanoid_description.robot import Robot

__all__ = ['Outcome', 'check_robot']


def check_robot(robot: Robot) -> list[Outcome]:
    """
    Run the checks on a robot model; later ones depend on the results of earlier ones.

    Parameters
    ----------
    robot
        The model as it was parsed, sound or not.

    Returns
    -------
    list of Outcome
        One for each check, in the order of the report. Checks are skipped after defects, and
        those of the humanoid for any other robot.

    """
    outcomes = [check(robot) for check in STRUCTURE]
    for group in (BODIES + JOINTS + MESHES, NAMES, SHAPE):
        outcomes += _checked(robot, group, _obstacle(robot, group, outcomes))
    return outcomes


def _obstacle(robot: Robot, group: Iterable[Check], before: list[Outcome]) -> str:
    """Return the reason to skip a group of checks; empty if there is none."""
    if group in (NAMES, SHAPE) and robot.name != NAME:
        return f"the robot '{robot.name}' is not the humanoid"
    if any(outcome.defects for outcome in before):
        return 'fix the defects first'
    return ''


def _checked(robot: Robot, group: Iterable[Check], obstacle: str) -> list[Outcome]:
    """Run checks, or skip them."""
    return [check.skip(obstacle) if obstacle else check(robot) for check in group]
