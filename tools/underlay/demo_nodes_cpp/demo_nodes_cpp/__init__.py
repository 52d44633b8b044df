# SPDX-License-Identifier: Apache-2.0
"""The nodes of demo_nodes_cpp, made of those of demo_nodes_py."""
