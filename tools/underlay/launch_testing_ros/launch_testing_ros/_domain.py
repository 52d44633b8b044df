# SPDX-License-Identifier: Apache-2.0
"""Keep the nodes of a test apart from all others."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os

_DISABLED = 'DISABLE_ROS_ISOLATION'
_NAMES = ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE')


@contextmanager
def isolated_domain() -> Iterator[None]:
    """Use a domain that no other test on this machine uses, and that other machines do not see."""
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
