# SPDX-License-Identifier: Apache-2.0
"""Expand the model once for all tests."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest
import xacro

MODEL = Path(__file__).parents[1] / 'urdf' / 'humanoid.urdf.xacro'


@pytest.fixture(name='robot', scope='session')
def _robot() -> ElementTree.Element:
    """Return the URDF of the humanoid."""
    return ElementTree.fromstring(xacro.process_file(str(MODEL)).toxml())
