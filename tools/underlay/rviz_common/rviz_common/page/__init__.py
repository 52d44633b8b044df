# SPDX-License-Identifier: Apache-2.0
"""Pages in the browser, with access control; `viser` is only imported for pages that use it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from rviz_common.page.address import NO_TOKEN, PageSettings, PortError
    from rviz_common.page.page import Page
    from rviz_common.page.plain_page import PlainPage
    from rviz_common.page.routes import Route

__all__ = ['NO_TOKEN', 'Page', 'PageSettings', 'PlainPage', 'PortError', 'Route']

_ADDRESS = dict.fromkeys(['NO_TOKEN', 'PageSettings', 'PortError'], 'address')
__getattr__, __dir__ = lazy_exports(__name__, __all__, {**_ADDRESS, 'Route': 'routes'})
