# SPDX-License-Identifier: Apache-2.0
"""Check that the controller asks for what the humanoid can do."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from ament_index_python.packages import get_package_share_directory
from humanoid_control.joint_controller import JointControllerParameters
from humanoid_control.sine_motion import Sinusoid
import pytest
import xacro


@pytest.fixture(name='robot', scope='module')
def _robot() -> ElementTree.Element:
    """Return the URDF of the humanoid."""
    share = Path(get_package_share_directory('humanoid_description'))
    document = xacro.process_file(str(share / 'urdf' / 'humanoid.urdf.xacro'))
    return ElementTree.fromstring(document.toxml())


@pytest.mark.parametrize('swing', JointControllerParameters().motion.swings)
def test_default_motion_within_the_limits(robot: ElementTree.Element, swing: Sinusoid) -> None:
    """Every joint that is moved exists, and reaches and follows its amplitude."""
    limit = robot.find(f"joint[@name='{swing.joint}']/limit")
    assert limit is not None
    assert float(limit.attrib['lower']) <= -swing.amplitude_rad
    assert float(limit.attrib['upper']) >= swing.amplitude_rad
    assert float(limit.attrib['velocity']) >= swing.amplitude_rad * swing.frequency_rad_s
