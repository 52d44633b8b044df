# SPDX-License-Identifier: Apache-2.0
"""Files of displays (.rviz): what they say, and how they are written back."""

from rviz_common.config.config_error import ConfigError
from rviz_common.config.configuration import Configuration
from rviz_common.config.document import Document, Place

__all__ = ['ConfigError', 'Configuration', 'Document', 'Place']
