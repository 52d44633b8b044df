# SPDX-License-Identifier: Apache-2.0
"""The parameters of nodes, as texts and from texts."""
