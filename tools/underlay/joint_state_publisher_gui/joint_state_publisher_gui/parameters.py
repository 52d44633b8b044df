# SPDX-License-Identifier: Apache-2.0
"""The parameters that the publisher with a page has in addition."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from joint_state_publisher.parameters import Extra
from joint_state_publisher.settings import checked
from rviz_common.page.settings import PageSettings, PARAMETERS

__all__ = ['EXTRAS', 'page_settings_of']

EXTRAS = {
    'num_rows': Extra(0, 'Means nothing here: the page scrolls.'),
    **{name: Extra(*about) for name, about in PARAMETERS.items()},
}


def page_settings_of(values: Mapping[str, Any]) -> PageSettings:
    """
    Validate the parameters that say where the page is served, and to whom.

    Parameters
    ----------
    values
        Values of `host`, `port` (0 for the first free one) and `token` by name.

    Raises
    ------
    ValueError
        A value is invalid.

    """
    host = checked('host', values['host'], '')
    token = checked('token', values['token'], '')
    port = checked('port', values['port'], 0.0)
    if not float(port).is_integer():
        raise ValueError(f"The parameter 'port' must be a whole number, and not {port:g}.")
    return PageSettings(host, int(port) or None, token)
