// The sample in a scene: put it on an empty object. Arrow keys push the first puck, A and D the second.
// SPDX-License-Identifier: MIT
#if UNITY_5_3_OR_NEWER
using UnityEngine;

namespace Isostep.Samples
{
    public sealed class TwoPucksBehaviour : MonoBehaviour
    {
        [Tooltip("of the line between the two machines")]
        public string profile = "latency=80,jitter=20,loss=5";

        private readonly Transform[] pucks = new Transform[2];
        private SimulatedNetwork network;
        private TwoPucks host;
        private TwoPucks client;
        private uint line;

        private void Start()
        {
            network = new SimulatedNetwork(1);
            host = new TwoPucks(20);
            client = new TwoPucks(0);
            line = network.AddClient(profile);
            network.Connect(line, 0);
            for (int n = 0; n < 2; ++n) pucks[n] = GameObject.CreatePrimitive(PrimitiveType.Sphere).transform;
        }

        private void Update()
        {
            ulong now = (ulong)(Time.unscaledTimeAsDouble * 1e6);
            network.AdvanceTo(now);
            Turn(0, host, 0, Way(KeyCode.LeftArrow, KeyCode.RightArrow), now);
            Turn(line, client, 1, Way(KeyCode.A, KeyCode.D), now);
            RenderPoseView poses = host.World.Poses(1);
            for (int i = 0; i < poses.Count; ++i) Draw(poses[i]);
        }

        private void Draw(RenderPose pose)
        {
            for (int n = 0; n < 2; ++n)
            {
                if (pose.Body != host.Pucks[n]) continue;
                Float4 turn = pose.Orientation;
                pucks[n].SetPositionAndRotation(new Vector3(pose.Position.X, pose.Position.Y, -pose.Position.Z),
                    new Quaternion(-turn.X, -turn.Y, turn.Z, turn.W));
            }
        }

        private static int Way(KeyCode left, KeyCode right)
        {
            return (Input.GetKey(right) ? 1 : 0) - (Input.GetKey(left) ? 1 : 0);
        }

        private void Turn(uint endpoint, TwoPucks game, int player, int way, ulong now)
        {
            network.Deliver(endpoint, game.Session, now);
            game.Turn(player, way, now);
            network.Dispatch(endpoint, game.Session, now);
        }

        private void OnDestroy()
        {
            host.Dispose();
            client.Dispose();
            network.Dispose();
        }
    }
}
#endif
