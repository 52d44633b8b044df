# SPDX-License-Identifier: Apache-2.0
"""Set the positions of the joints of a robot with sliders in the browser."""
