# SPDX-License-Identifier: Apache-2.0
"""The additional parameters of the publisher with a page."""

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
    Validate the parameters that set the address, port and access token of the page.

    Parameters
    ----------
    values
        Values of `host`, `port` (0 for the first free port) and `token` by name.

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
