# SPDX-License-Identifier: Apache-2.0
"""Check what the nodes accept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from humanoid_common.parameters import build, ParameterError
import pytest
from temperature_monitor.temp_analyzer import AnalyzerParameters
from temperature_monitor.temp_publisher import PublisherParameters
import yaml

CONFIG = Path(__file__).parents[1] / 'config'


@pytest.mark.parametrize(
    ('kind', 'values', 'words'),
    [
        (PublisherParameters, {'min_celsius': 31.0}, "must be below 'max_celsius', which is 30.0"),
        (PublisherParameters, {'rate_hz': 0.0}, "'rate_hz' is 0.0"),
        (PublisherParameters, {'seed': -2}, "'seed' is -2"),
        (AnalyzerParameters, {'threshold_celsius': -300.0}, 'must be between -273.15'),
    ],
)
def test_refused(kind: type, values: dict[str, Any], words: str) -> None:
    """Impossible values are refused with the reason."""
    with pytest.raises(ParameterError) as caught:
        build(kind, values)
    assert words in caught.value.reason


@pytest.mark.parametrize(
    ('kind', 'file_name'),
    [(PublisherParameters, 'temp_publisher.yaml'), (AnalyzerParameters, 'temp_analyzer.yaml')],
)
def test_configuration_file(kind: type, file_name: str) -> None:
    """The shipped file names every parameter and says the same as the defaults."""
    values = yaml.safe_load((CONFIG / file_name).read_text())['/**']['ros__parameters']
    assert set(values) == set(kind.__dataclass_fields__)  # type: ignore[attr-defined]
    assert build(kind, values) == kind()
