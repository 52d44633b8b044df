# SPDX-License-Identifier: Apache-2.0
"""Behavior trees of BehaviorTree.CPP v4 with the nodes of Nav2, executed on py_trees."""

from nav2_behavior_tree.blackboard import Blackboard
from nav2_behavior_tree.control_node import Control, Decorator
from nav2_behavior_tree.node import NodeConfig, TreeContext, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port
from nav2_behavior_tree.registry import register, registered_types
from nav2_behavior_tree.status import Failure, NodeStatus, StatusChange, TreeError
from nav2_behavior_tree.tree import BehaviorTree
from nav2_behavior_tree.tree_xml import Document, read_tree_file, read_tree_text

__all__ = [
    'BehaviorTree',
    'Blackboard',
    'Control',
    'Decorator',
    'Document',
    'Failure',
    'NodeConfig',
    'NodeStatus',
    'Port',
    'StatusChange',
    'TreeContext',
    'TreeError',
    'TreeNode',
    'in_port',
    'out_port',
    'read_tree_file',
    'read_tree_text',
    'register',
    'registered_types',
]
