# SPDX-License-Identifier: Apache-2.0
"""Check what the joint controller accepts."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from humanoid_common.parameters import build, ParameterError
from humanoid_control.joint_controller import JointControllerParameters
from humanoid_control.sensor_processor import SensorProcessorParameters
import pytest
import yaml

CONFIG = Path(__file__).parents[1] / 'config'


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'joints': ['a', 'b']}, "'amplitudes_rad' has 4 elements, but 'joints' has 2"),
        ({'phases_rad': [0.0]}, "'phases_rad' has 1 elements, but 'joints' has 4"),
        ({'joints': ['a', 'b', 'a', 'c']}, "names 'a' more than once"),
        ({'joints': ['a', '', 'b', 'c']}, 'an empty name'),
        ({'joints': []}, 'must not be empty'),
        ({'amplitudes_rad': [math.nan, 0.0, 0.0, 0.0]}, 'must be finite'),
        ({'frequencies_rad_s': [1.7e308, 1.0, 1.0, 1.0]}, 'between -1000.0 and 1000.0'),
        ({'rate_hz': 1001.0}, 'must be between 1.0 and 1000.0'),
    ],
)
def test_refused(values: dict[str, Any], words: str) -> None:
    """Values that make no motion are refused with the reason."""
    with pytest.raises(ParameterError) as caught:
        build(JointControllerParameters, values)
    assert words in caught.value.reason


@pytest.mark.parametrize(
    ('kind', 'file_name'),
    [
        (JointControllerParameters, 'joint_controller.yaml'),
        (SensorProcessorParameters, 'sensor_processor.yaml'),
    ],
)
def test_configuration_file(kind: type, file_name: str) -> None:
    """The shipped file names every parameter and says the same as the defaults."""
    values = yaml.safe_load((CONFIG / file_name).read_text())['/**']['ros__parameters']
    assert set(values) == set(kind.__dataclass_fields__)  # type: ignore[attr-defined]
    assert build(kind, values) == kind()
