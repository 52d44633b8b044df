# SPDX-License-Identifier: Apache-2.0
"""Expand the model once for all tests."""

from __future__ import annotations

from xml.etree import ElementTree

from humanoid_description.expansion import humanoid_urdf
import pytest


@pytest.fixture(name='urdf', scope='session')
def _urdf() -> str:
    """Return the URDF of the humanoid."""
    return humanoid_urdf()


@pytest.fixture(name='robot', scope='session')
def _robot(urdf: str) -> ElementTree.Element:
    """Return the URDF of the humanoid as a tree of elements."""
    return ElementTree.fromstring(urdf)
