// The structs of panache.h that the package passes; a test compares them with the header.
import { struct } from './memory.js';

export const kJoint = struct({ name: 'i32', parent: 'i32', rotation: ['f32', 4], translation: ['f32', 3] });
export const kHumanJoint = struct({ vrmName: 'i32', joint: 'i32' });
export const kSkeletonOptions = struct({ structSize: 'i32', metresPerUnit: 'f32', upAxis: 'i32',
  rotations: 'i32', translations: 'i32', poseCount: 'i32', humanJointCount: 'i32', humanJoints: 'i32' });
export const kCharacterOptions = struct({ structSize: 'i32', easeSeconds: 'f32',
  smoothingSeconds: 'f32', holdFeet: 'i32', styleRoot: 'i32', skipCycles: 'i32', maxLag: 'f64',
  maxLead: 'f64', maxSpeed: 'f64', remover: 'i32', gestureRate: 'f32', gestureSeed: 'i32' });
export const kStylizeOptions = struct({ structSize: 'i32', easeSeconds: 'f32', smoothingSeconds: 'f32',
  holdFeet: 'i32', styleRoot: 'i32', styleTiming: 'i32', shape: 'i32', maxSpeed: 'f64', loop: 'i32',
  removed: 'i32', remover: 'i32', gestureRate: 'f32', gestureSeed: 'i32', sides: 'i32', person: 'i32' });
export const kShape = struct({ structSize: 'i32', strength: 'f32', posture: 'f32', dynamics: 'f32',
  timing: 'f32', legs: 'f32', torso: 'f32', leftArm: 'f32', rightArm: 'f32', footLock: 'f32',
  handContacts: 'f32', energy: 'f32' });
export const kReport = struct({ structSize: 'i32', gate: 'f32', contacts: ['f32', 2], rate: 'f64',
  ahead: 'f64' });
export const kInputPose = struct({ rotations: 'i32', translations: 'i32' });
export const kStrengthKey = struct({ seconds: 'f64', strength: 'f32' });
export const kStrengthTrack = struct({ style: 'i32', keyCount: 'i32', keys: 'i32' });
export const kClip = struct({ skeleton: 'i32', frameCount: 'i32', frameSeconds: 'f64', rotations: 'i32',
  translations: 'i32' });
