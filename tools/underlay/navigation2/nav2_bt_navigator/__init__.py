# SPDX-License-Identifier: Apache-2.0
"""Navigation by behavior trees."""

from nav2_bt_navigator.bt_navigator import BtNavigator
from nav2_bt_navigator.tree_files import TREE_FOLDER

__all__ = ['TREE_FOLDER', 'BtNavigator']
