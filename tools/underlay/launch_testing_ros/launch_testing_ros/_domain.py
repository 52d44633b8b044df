# SPDX-License-Identifier: Apache-2.0
"""Isolate the nodes of a test in their own ROS domain."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os

_DISABLED = 'DISABLE_ROS_ISOLATION'
_NAMES = ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE')


@contextmanager
def isolated_domain() -> Iterator[None]:
    """Use a ROS domain that is unique on this machine and invisible to other machines."""
    if _DISABLED in os.environ:
        yield
        return
    from domain_coordinator import domain_id

    before = {name: os.environ.pop(name, None) for name in _NAMES}
    try:
        with domain_id() as domain:
            os.environ.update(zip(_NAMES, (str(domain), 'LOCALHOST')))
            yield
    finally:
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
