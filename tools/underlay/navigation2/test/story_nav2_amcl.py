# SPDX-License-Identifier: Apache-2.0
"""The localizer follows the robot in the flat for long, and from anywhere: `make stories`."""

from __future__ import annotations

from pathlib import Path
import sys

from nav2_amcl.motion_models import MOTION_MODELS
import pytest

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported by their files
from amcl_flat import follow, make_localizer, START, Walker  # noqa: E402, I100


@pytest.mark.parametrize('motion', sorted(MOTION_MODELS))
def test_tracks_five_minutes(motion):
    """After five minutes of walking, the error stays below 0.15 m and 5 degrees."""
    localizer, walker = make_localizer(motion_model=motion), Walker(1)
    localizer.start_at(START)
    errors = follow(localizer, walker, 300.0)
    assert errors[5:, 0].max() < 0.15
    assert errors[5:, 1].max() < 5.0


@pytest.mark.parametrize('seed', range(4))
@pytest.mark.parametrize('laser', ['likelihood_field', 'likelihood_field_prob'])
def test_finds_itself_anywhere(seed, laser):
    """Global localisation converges after some metres."""
    localizer, walker = make_localizer(seed, laser_model=laser), Walker(seed)
    localizer.start_anywhere()
    errors = follow(localizer, walker, 45.0)
    assert errors[-5:, 0].max() < 0.2
    assert localizer.estimate.weight > 0.9
