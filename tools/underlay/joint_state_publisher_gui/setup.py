# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'joint_state_publisher_gui'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Publishes the joint states of a robot, whose joints are moved in the browser.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'joint_state_publisher_gui = joint_state_publisher_gui.program:main',
        ],
    },
)
