# SPDX-License-Identifier: Apache-2.0
"""Configuration files (.rviz): reading, editing and writing them."""

from rviz_common.config.configuration import Configuration
from rviz_common.config.yaml_file import ConfigError, Document, Place

__all__ = ['ConfigError', 'Configuration', 'Document', 'Place']
