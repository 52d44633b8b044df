# SPDX-License-Identifier: Apache-2.0
"""Start processes, read their output, and make sure that they terminate."""
