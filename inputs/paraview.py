# Draws the last frame of a run by ParaView 5.11 or later: particles as balls of one spacing, coloured by stress, only
# those with a damage below 0.35, which leaves cracks as gaps. In the program's window the same filters have these names.
#     pvpython inputs/paraview.py results/NAME/frames.hdf.series picture.png
import sys
from paraview.simple import *

frames = OpenDataFile(sys.argv[1])
AnimationScene = GetAnimationScene(); AnimationScene.UpdateAnimationUsingDataTimeSteps(); AnimationScene.GoToLast()
intact = Threshold(Input=frames, Scalars=['POINTS', 'damage'], ThresholdMethod='Below Lower Threshold', LowerThreshold=0.35)
area = 1; [area := area * edge for edge in (b - a for a, b in zip(*[iter(frames.GetDataInformation().GetBounds())] * 2)) if edge > 0]
