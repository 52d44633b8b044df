# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'rviz_common'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed', 'web/*']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    author='Humanoid workspace maintainers',
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='What RViz in the browser is made of: page, properties, displays and panels.',
    license='Apache-2.0',
    tests_require=['pytest'],
    entry_points={
        'rviz_common.panels': [
            'rviz_common/Displays = rviz_common.panels.displays_panel:DisplaysPanel',
            'rviz_common/Selection = rviz_common.panels.selection_panel:SelectionPanel',
            'rviz_common/Time = rviz_common.panels.time_panel:TimePanel',
            'rviz_common/Tool Properties = '
            'rviz_common.panels.view_and_tool_panels:ToolPropertiesPanel',
            'rviz_common/Views = rviz_common.panels.view_and_tool_panels:ViewsPanel',
        ],
    },
)
