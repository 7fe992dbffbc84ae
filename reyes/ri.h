/* The RenderMan C binding (RISpec 3.2, appendix C) for plugins of Procedural "DynamicLoad": attributes, transformations
 * and geometry. A plugin defines, with C linkage,
 *
 *   RtPointer ConvertParameters(char* text);  makes data of its own from the second string of the Procedural
 *   void Subdivide(RtPointer data, RtFloat detail_px2);  makes the calls below for a bound of so many pixels
 *   void Free(RtPointer data);
 *
 * and is built as a shared library without linking anything: the renderer has the functions (docs/procedurals.md).
 * Threads: one plugin function runs at a time in the whole process. Calls are kept until Subdivide returns and then
 * read as if they stood in the RIB; they may be made by the thread that Subdivide runs in, until it returns. Pointers
 * are read before a call returns. A token has as many values as its declaration and the primitive ask for, as in RIB.
 * Strings are arrays of RtString. */
#ifndef TOMALES_RI_H
#define TOMALES_RI_H

#ifdef __cplusplus
extern "C" {
#endif

typedef short RtBoolean;
typedef int RtInt;
typedef float RtFloat;
typedef const char* RtToken;
typedef const char* RtString;
typedef void RtVoid;
typedef void* RtPointer;
typedef RtFloat RtColor[3]; /* has as many as ColorSamples says, else 3 */
typedef RtFloat RtPoint[3], RtVector[3], RtNormal[3], RtHpoint[4];
typedef RtFloat RtMatrix[4][4], RtBasis[4][4];
typedef RtFloat RtBound[6]; /* xmin xmax ymin ymax zmin zmax */
typedef RtPointer RtObjectHandle, RtLightHandle;
typedef RtVoid (*RtProcSubdivFunc)(RtPointer data, RtFloat detail);
typedef RtVoid (*RtProcFreeFunc)(RtPointer data);

#define RI_FALSE 0
#define RI_TRUE 1
#define RI_NULL ((RtToken)0) /* ends the tokens and values of a variadic call */
#define RI_INFINITY ((RtFloat)1.0e38)
#define RI_EPSILON ((RtFloat)1.0e-10)

#define RI_P "P"
#define RI_PZ "Pz"
#define RI_PW "Pw"
#define RI_N "N"
#define RI_NP "Np"
#define RI_CS "Cs"
#define RI_OS "Os"
#define RI_S "s"
#define RI_T "t"
#define RI_ST "st"
#define RI_WIDTH "width"
#define RI_CONSTANTWIDTH "constantwidth"
#define RI_BILINEAR "bilinear"
#define RI_BICUBIC "bicubic"
#define RI_LINEAR "linear"
#define RI_CUBIC "cubic"
#define RI_PERIODIC "periodic"
#define RI_NONPERIODIC "nonperiodic"
#define RI_PRIMITIVE "primitive"
#define RI_UNION "union"
#define RI_INTERSECTION "intersection"
#define RI_DIFFERENCE "difference"

/* Bases that RiBasis knows, and their steps. */
extern RtBasis RiBezierBasis, RiBSplineBasis, RiCatmullRomBasis, RiHermiteBasis, RiPowerBasis;
#define RI_BEZIERSTEP 3
#define RI_BSPLINESTEP 1
#define RI_CATMULLROMSTEP 1
#define RI_HERMITESTEP 2
#define RI_POWERSTEP 4

/* Where a function takes tokens and values, its V form takes them as arrays. */
#define RI_ARRAYS RtInt n, const RtToken tokens[], const RtPointer values[]

/* Blocks and archives */
RtToken RiDeclare(RtToken name, RtToken declaration);
RtVoid RiAttributeBegin(void);
RtVoid RiAttributeEnd(void);
RtVoid RiTransformBegin(void);
RtVoid RiTransformEnd(void);
RtVoid RiSolidBegin(RtToken operation);
RtVoid RiSolidEnd(void);
RtObjectHandle RiObjectBegin(void);
RtVoid RiObjectEnd(void);
RtVoid RiObjectInstance(RtObjectHandle handle);
RtVoid RiMotionBegin(RtInt n, ...); /* n times, as double */
RtVoid RiMotionBeginV(RtInt n, const RtFloat times[]);
RtVoid RiMotionEnd(void);
RtVoid RiReadArchive(RtToken name, void (*callback)(RtToken, char*, ...), ...); /* the callback is not called */
RtVoid RiReadArchiveV(RtToken name, void (*callback)(RtToken, char*, ...), RI_ARRAYS);

/* Attributes */
RtVoid RiAttribute(RtToken name, ...);
RtVoid RiAttributeV(RtToken name, RI_ARRAYS);
RtVoid RiColor(const RtFloat color[]);
RtVoid RiOpacity(const RtFloat opacity[]);
RtVoid RiTextureCoordinates(RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3, RtFloat s4,
                            RtFloat t4);
RtVoid RiSurface(RtToken name, ...);
RtVoid RiSurfaceV(RtToken name, RI_ARRAYS);
RtVoid RiDisplacement(RtToken name, ...);
RtVoid RiDisplacementV(RtToken name, RI_ARRAYS);
RtVoid RiAtmosphere(RtToken name, ...);
RtVoid RiAtmosphereV(RtToken name, RI_ARRAYS);
RtVoid RiInterior(RtToken name, ...);
RtVoid RiInteriorV(RtToken name, RI_ARRAYS);
RtVoid RiExterior(RtToken name, ...);
RtVoid RiExteriorV(RtToken name, RI_ARRAYS);
RtLightHandle RiLightSource(RtToken name, ...); /* refused inside procedurals, with a message */
RtLightHandle RiLightSourceV(RtToken name, RI_ARRAYS);
RtLightHandle RiAreaLightSource(RtToken name, ...);
RtLightHandle RiAreaLightSourceV(RtToken name, RI_ARRAYS);
RtVoid RiIlluminate(RtLightHandle light, RtBoolean on);
RtVoid RiShadingRate(RtFloat area_px2);
RtVoid RiShadingInterpolation(RtToken type);
RtVoid RiMatte(RtBoolean on);
RtVoid RiBound(const RtBound bound);
RtVoid RiDetail(const RtBound bound);
RtVoid RiDetailRange(RtFloat minvisible, RtFloat lower, RtFloat upper, RtFloat maxvisible);
RtVoid RiGeometricApproximation(RtToken type, RtFloat value);
RtVoid RiOrientation(RtToken orientation);
RtVoid RiReverseOrientation(void);
RtVoid RiSides(RtInt sides);

/* Transformations */
RtVoid RiIdentity(void);
RtVoid RiTransform(RtMatrix transform);
RtVoid RiConcatTransform(RtMatrix transform);
RtVoid RiPerspective(RtFloat fov_degrees);
RtVoid RiTranslate(RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiRotate(RtFloat angle_degrees, RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiScale(RtFloat sx, RtFloat sy, RtFloat sz);
RtVoid RiSkew(RtFloat angle_degrees, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2, RtFloat dz2);
RtVoid RiCoordinateSystem(RtToken space);
RtVoid RiScopedCoordinateSystem(RtToken space);
RtVoid RiCoordSysTransform(RtToken space);

/* Geometry */
RtVoid RiPolygon(RtInt nvertices, ...);
RtVoid RiPolygonV(RtInt nvertices, RI_ARRAYS);
RtVoid RiGeneralPolygon(RtInt nloops, const RtInt nvertices[], ...);
RtVoid RiGeneralPolygonV(RtInt nloops, const RtInt nvertices[], RI_ARRAYS);
RtVoid RiPointsPolygons(RtInt npolys, const RtInt nvertices[], const RtInt vertices[], ...);
RtVoid RiPointsPolygonsV(RtInt npolys, const RtInt nvertices[], const RtInt vertices[], RI_ARRAYS);
RtVoid RiPointsGeneralPolygons(RtInt npolys, const RtInt nloops[], const RtInt nvertices[], const RtInt vertices[],
                               ...);
RtVoid RiPointsGeneralPolygonsV(RtInt npolys, const RtInt nloops[], const RtInt nvertices[], const RtInt vertices[],
                                RI_ARRAYS);
RtVoid RiBasis(RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep);
RtVoid RiPatch(RtToken type, ...);
RtVoid RiPatchV(RtToken type, RI_ARRAYS);
RtVoid RiPatchMesh(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, ...);
RtVoid RiPatchMeshV(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, RI_ARRAYS);
RtVoid RiNuPatch(RtInt nu, RtInt uorder, const RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                 const RtFloat vknot[], RtFloat vmin, RtFloat vmax, ...);
RtVoid RiNuPatchV(RtInt nu, RtInt uorder, const RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                  const RtFloat vknot[], RtFloat vmin, RtFloat vmax, RI_ARRAYS);
RtVoid RiTrimCurve(RtInt nloops, const RtInt ncurves[], const RtInt order[], const RtFloat knot[], const RtFloat min[],
                   const RtFloat max[], const RtInt n[], const RtFloat u[], const RtFloat v[], const RtFloat w[]);
RtVoid RiSubdivisionMesh(RtToken scheme, RtInt nfaces, const RtInt nvertices[], const RtInt vertices[], RtInt ntags,
                         const RtToken tags[], const RtInt nargs[], const RtInt intargs[], const RtFloat floatargs[],
                         ...);
RtVoid RiSubdivisionMeshV(RtToken scheme, RtInt nfaces, const RtInt nvertices[], const RtInt vertices[], RtInt ntags,
                          const RtToken tags[], const RtInt nargs[], const RtInt intargs[], const RtFloat floatargs[],
                          RI_ARRAYS);
RtVoid RiSphere(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiSphereV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RI_ARRAYS);
RtVoid RiCone(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiConeV(RtFloat height, RtFloat radius, RtFloat thetamax, RI_ARRAYS);
RtVoid RiCylinder(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiCylinderV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RI_ARRAYS);
RtVoid RiHyperboloid(const RtPoint point1, const RtPoint point2, RtFloat thetamax, ...);
RtVoid RiHyperboloidV(const RtPoint point1, const RtPoint point2, RtFloat thetamax, RI_ARRAYS);
RtVoid RiParaboloid(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiParaboloidV(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RI_ARRAYS);
RtVoid RiDisk(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiDiskV(RtFloat height, RtFloat radius, RtFloat thetamax, RI_ARRAYS);
RtVoid RiTorus(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax, RtFloat thetamax, ...);
RtVoid RiTorusV(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax, RtFloat thetamax, RI_ARRAYS);
RtVoid RiPoints(RtInt npoints, ...);
RtVoid RiPointsV(RtInt npoints, RI_ARRAYS);
RtVoid RiCurves(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, ...);
RtVoid RiCurvesV(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, RI_ARRAYS);
RtVoid RiBlobby(RtInt nleaf, RtInt ncode, const RtInt code[], RtInt nfloats, const RtFloat floats[], RtInt nstrings,
                const RtString strings[], ...);
RtVoid RiBlobbyV(RtInt nleaf, RtInt ncode, const RtInt code[], RtInt nfloats, const RtFloat floats[], RtInt nstrings,
                 const RtString strings[], RI_ARRAYS);
RtVoid RiGeometry(RtToken type, ...);
RtVoid RiGeometryV(RtToken type, RI_ARRAYS);

/* `free` is called when `data` is not needed any more; it may be null. `subdivide` is a function of the plugin or one
 * of the three below. Their data are arrays of RtString: a file; a program and its data; a plugin and its text. */
RtVoid RiProcedural(RtPointer data, const RtBound bound, RtProcSubdivFunc subdivide, RtProcFreeFunc free);
RtVoid RiProcDelayedReadArchive(RtPointer data, RtFloat detail);
RtVoid RiProcRunProgram(RtPointer data, RtFloat detail);
RtVoid RiProcDynamicLoad(RtPointer data, RtFloat detail);

#ifdef __cplusplus
}
#endif
#endif
