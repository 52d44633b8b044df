# SPDX-License-Identifier: Apache-2.0
"""A page in the browser, with access control."""

from rviz_common.page.listening import PortError
from rviz_common.page.page import Page
from rviz_common.page.routes import Route
from rviz_common.page.settings import NO_TOKEN, PageSettings

__all__ = ['NO_TOKEN', 'Page', 'PageSettings', 'PortError', 'Route']
