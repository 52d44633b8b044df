# SPDX-License-Identifier: Apache-2.0
"""A page in the browser, with access control."""

from rviz_common.page.address import NO_TOKEN, PageSettings, PortError
from rviz_common.page.page import Page
from rviz_common.page.routes import Route

__all__ = ['NO_TOKEN', 'Page', 'PageSettings', 'PortError', 'Route']
