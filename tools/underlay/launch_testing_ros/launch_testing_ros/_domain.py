# SPDX-License-Identifier: Apache-2.0
"""Keep the nodes of a test apart from all others."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os

_DOMAIN = 'ROS_DOMAIN_ID'
_DISABLED = 'DISABLE_ROS_ISOLATION'


@contextmanager
def isolated_domain() -> Iterator[None]:
    """Set the domain to one that no other test on this machine uses, unless the user set one."""
    if _DOMAIN in os.environ or _DISABLED in os.environ:
        yield
        return
    from domain_coordinator import domain_id

    with domain_id() as domain:
        os.environ[_DOMAIN] = str(domain)
        try:
            yield
        finally:
            os.environ.pop(_DOMAIN, None)
