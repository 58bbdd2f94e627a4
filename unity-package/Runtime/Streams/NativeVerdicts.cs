using System;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>What a native result says of each edge, read where it lies.</summary>
    internal struct NativeVerdicts
    {
        private readonly IntPtr first;
        private readonly int count;

        /// <summary>Valid as long as the result.</summary>
        internal NativeVerdicts(ResultHandle result)
        {
            uint found;
            Failure.Require(NativeMethods.ResultVerdicts(result, out first, out found));
            count = (int)found;
        }

        /// <summary>How many edges have which outcome for which reason.</summary>
        internal unsafe int[] Counts()
        {
            var counts = new int[ChamferReport.OutcomeSlots * NativeTotals.ReasonSlots];
            for (int i = 0; i < count; i++)
            {
                var verdict = (NativeEdgeVerdict*)first + i;
                counts[verdict->Outcome * NativeTotals.ReasonSlots + verdict->Reason]++;
            }
            return counts;
        }

        internal unsafe EdgeVerdict[] ToArray()
        {
            var verdicts = new EdgeVerdict[count];
            for (int i = 0; i < count; i++) { verdicts[i] = Verdict((NativeEdgeVerdict*)first + i); }
            return verdicts;
        }

        private static unsafe EdgeVerdict Verdict(NativeEdgeVerdict* native)
        {
            return new EdgeVerdict
            {
                FirstVertex = (int)native->Vertices[0],
                SecondVertex = (int)native->Vertices[1],
                Outcome = (EdgeOutcome)native->Outcome,
                Reason = (EdgeReason)native->Reason,
                FirstWidth = native->Widths[0],
                SecondWidth = native->Widths[1],
                Segments = (int)native->Segments
            };
        }
    }
}
