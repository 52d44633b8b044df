# SPDX-License-Identifier: Apache-2.0
"""The types of nodes; `nav2_behavior_tree.registry` knows them by name."""
