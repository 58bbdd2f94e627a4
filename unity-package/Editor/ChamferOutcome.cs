using System.Collections.Generic;

namespace ChamferEditor
{
    /// <summary>What came of a call of <see cref="ChamferTools"/>.</summary>
    public sealed class ChamferOutcome
    {
        private readonly string text;

        internal ChamferOutcome(bool isDone, JobSummary summary)
        {
            IsDone = isDone;
            Failures = summary.Failures;
            text = isDone ? summary.ToString() : "cancelled, nothing was changed";
        }

        /// <summary>False if the user cancelled; then nothing was changed.</summary>
        public bool IsDone { get; }

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        public IReadOnlyList<string> Failures { get; }

        /// <summary>What was done, in words.</summary>
        public override string ToString()
        {
            return text;
        }
    }
}
