# A picture of the last frame of a run by ParaView 5.11 or later: what is not cracked, as balls of one spacing, by
# von Mises' stress where the run has it (`output: {fields: [von_mises]}`), else by the stress along y.
#     pvpython inputs/draw_paraview.py results/NAME/frames.hdf.series SPACING picture.png         SPACING in metres
# In the window of ParaView the same filters have these names: Threshold, Glyph.
import sys
from paraview.simple import *

frames = OpenDataFile(sys.argv[1])
intact = Threshold(Input=frames, Scalars=['POINTS', 'damage'], ThresholdMethod='Below Lower Threshold', LowerThreshold=0.35)
balls = Glyph(Input=intact, GlyphType='Sphere', ScaleArray=['POINTS', 'No scale array'], GlyphMode='All Points')
balls.ScaleFactor = float(sys.argv[2])
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().GoToLast()
shown, view = Show(balls), GetActiveViewOrCreate('RenderView')
if 'von_mises' in frames.PointData.keys():
    ColorBy(shown, ('POINTS', 'von_mises'))
else:
    ColorBy(shown, ('POINTS', 'stress', 'YY'))
shown.RescaleTransferFunctionToDataRange()
shown.SetScalarBarVisibility(view, True)
ResetCamera(view)
SaveScreenshot(sys.argv[3], view, ImageResolution=[1200, 900])
