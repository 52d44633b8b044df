# SPDX-License-Identifier: Apache-2.0
"""Tests of suggestions for misspelt names."""

from __future__ import annotations

import pytest
from ros_environment.suggestions import closest_name, did_you_mean

KNOWN = ['NavFn', 'SmacHybrid', 'ThetaStar']


@pytest.mark.parametrize(
    ('name', 'options', 'close'),
    [
        ('NavFm', {}, 'NavFn'),
        ('navfm', {}, ''),
        ('navfm', {'ignore_case': True}, 'NavFn'),
        ('Theta', {}, 'ThetaStar'),
        ('Theta', {'cutoff': 0.9}, ''),
        ('', {}, ''),
    ],
)
def test_closest_name(name: str, options: dict[str, object], close: str) -> None:
    """The most similar name, as it is written, unless none is similar enough."""
    assert closest_name(name, iter(KNOWN), **options) == close
    assert did_you_mean(name, KNOWN, **options) == (f"Did you mean '{close}'?" if close else '')
