# SPDX-License-Identifier: Apache-2.0
"""Read a URDF with MuJoCo."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

from humanoid_simulation.errors import SimulationError
import mujoco

# What MuJoCo discards by default when it reads a URDF: visuals, and links that are fixed to
# others, such as the frames of sensors.
_KEEP = {'discardvisual': 'false', 'fusestatic': 'false'}


def spec_of(urdf: str) -> Any:
    """
    Parse a URDF to a MuJoCo specification, with visuals and fixed links kept.

    Parameters
    ----------
    urdf
        Content of the URDF.

    Returns
    -------
    mujoco.MjSpec
        The robot, which can be extended before it is compiled.

    Raises
    ------
    SimulationError
        The text is not XML, or MuJoCo rejects it.

    """
    try:
        robot = ElementTree.fromstring(urdf)
    except ElementTree.ParseError as error:
        raise SimulationError(f'The robot cannot be simulated: its URDF is no XML: {error}.')
    for old in robot.findall('mujoco'):
        robot.remove(old)
    ElementTree.SubElement(ElementTree.SubElement(robot, 'mujoco'), 'compiler', _KEEP)
    try:
        return mujoco.MjSpec.from_string(ElementTree.tostring(robot, encoding='unicode'))
    except ValueError as error:
        raise SimulationError(
            f'The robot cannot be simulated: MuJoCo refuses its URDF: {error}. '
            'check_model says more about a URDF.'
        ) from error
