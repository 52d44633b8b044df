# SPDX-License-Identifier: Apache-2.0
"""Walking to a clicked place without navigation: the controller, the sessions and the tool."""
