# SPDX-License-Identifier: Apache-2.0
"""Drawing helpers of the displays."""
