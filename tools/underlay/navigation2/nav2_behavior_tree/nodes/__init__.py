# SPDX-License-Identifier: Apache-2.0
"""The node types; `nav2_behavior_tree.registry` maps their names to classes."""
